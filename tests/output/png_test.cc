#include "radiosity/output/png.h"

#include <gtest/gtest.h>
#include <stb/stb_image.h>

namespace lambert {
namespace {

TEST(EncodePng, PixelsComeBackInOrderAsSrgb) {
  const std::string png = EncodePng(2, 2, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.2140411, 2, -1}});
  int width = 0, height = 0, channels = 0;
  unsigned char* pixels =
      stbi_load_from_memory(reinterpret_cast<const unsigned char*>(png.data()),
                            static_cast<int>(png.size()), &width, &height, &channels, 3);
  ASSERT_NE(pixels, nullptr);
  EXPECT_EQ(width, 2);
  EXPECT_EQ(height, 2);
  const std::vector<unsigned char> expected = {255, 0, 0, 0, 255, 0, 0, 0, 255, 127, 255, 0};
  EXPECT_EQ(std::vector<unsigned char>(pixels, pixels + 12), expected);
  stbi_image_free(pixels);
}

}  // namespace
}  // namespace lambert

#include "radiosity/scene/image_decode.h"

#include <gtest/gtest.h>

#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

const unsigned char* Bytes(const std::string& text) {
  return reinterpret_cast<const unsigned char*>(text.data());
}

TEST(DecodeImage, GivesRowsFromTopToBottomInRgba) {
  const std::string codes = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  const std::string png = MakePng(2, 2, codes);
  EXPECT_EQ(ReadImageSize(Bytes(png), png.size(), "image")->width, 2);
  const absl::StatusOr<Texture> texture = DecodeImage(Bytes(png), png.size(), "image");
  ASSERT_TRUE(texture.ok()) << texture.status();
  EXPECT_EQ(texture->height, 2);
  EXPECT_EQ(texture->rgba, std::vector<uint8_t>(codes.begin(), codes.end()));
}

TEST(DecodeImage, BrokenAndForeignBytesAreRefused) {
  const std::string png = MakePng(2, 2, std::string(16, 'x'));
  for (const std::string& bad : {std::string(), std::string("GIF89a\1\0\1\0", 10), png.substr(0, 8),
                                 png.substr(0, 60), MakePng(2, 2, "")}) {
    EXPECT_FALSE(DecodeImage(Bytes(bad), bad.size(), "image 0").ok());
  }
}

TEST(ReadImageSize, ReadsTheHeaderAlone) {
  const std::string png = MakePng(10'000, 5'000, "");
  EXPECT_EQ(ReadImageSize(Bytes(png), png.size(), "image")->height, 5'000);
}

}  // namespace
}  // namespace lambert

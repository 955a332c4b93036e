#include "radiosity/output/texture_image.h"

#include <stb/stb_image_write.h>

#include <cstdint>
#include <vector>

#include "radiosity/output/exposure.h"
#include "radiosity/output/png.h"
#include "radiosity/patch/texture_mean.h"

namespace lambert {
namespace {

constexpr int kJpegQuality = 95;

}  // namespace

ImageBytes EncodeTexture(const Texture& texture, double gain) {
  std::vector<uint8_t> rgba = texture.rgba;
  bool opaque = true;
  for (size_t i = 0; i < rgba.size(); i += 4) {
    opaque = opaque && rgba[i + 3] == 255;
    if (!(gain > 1)) continue;
    const Rgb linear{SrgbToLinear(rgba[i]), SrgbToLinear(rgba[i + 1]), SrgbToLinear(rgba[i + 2])};
    const Rgb brighter = Develop(linear, {gain});
    for (int channel = 0; channel < 3; ++channel) {
      rgba[i + channel] = SrgbByte(brighter[channel]);
    }
  }
  ImageBytes image;
  const int width = texture.width, height = texture.height;
  if (opaque) {
    image.mime_type = "image/jpeg";
    stbi_write_jpg_to_func(AppendBytes, &image.bytes, width, height, 4, rgba.data(), kJpegQuality);
  } else {
    image.mime_type = "image/png";
    stbi_write_png_to_func(AppendBytes, &image.bytes, width, height, 4, rgba.data(), 4 * width);
  }
  return image;
}

}  // namespace lambert

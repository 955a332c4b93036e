#include "radiosity/output/png.h"

#include <stb/stb_image_write.h>

#include <cstdint>

#include "radiosity/output/exposure.h"

namespace lambert {

void AppendBytes(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                             static_cast<size_t>(size));
}

std::string EncodePng(int width, int height, const std::vector<Rgb>& display) {
  std::vector<uint8_t> bytes;
  bytes.reserve(3 * display.size());
  for (const Rgb& value : display) {
    for (int channel = 0; channel < 3; ++channel) bytes.push_back(SrgbByte(value[channel]));
  }
  std::string png;
  stbi_write_png_to_func(AppendBytes, &png, width, height, 3, bytes.data(), 3 * width);
  return png;
}

}  // namespace lambert

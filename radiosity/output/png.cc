#include "radiosity/output/png.h"

#include <stb/stb_image_write.h>

#include <cmath>
#include <cstdint>

#include "radiosity/output/exposure.h"

namespace lambert {

void AppendBytes(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                             static_cast<size_t>(size));
}

std::string EncodePng(int width, int height, const std::vector<Rgb>& display,
                      const std::vector<float>& alpha) {
  const int channels = alpha.empty() ? 3 : 4;
  std::vector<uint8_t> bytes;
  bytes.reserve(channels * display.size());
  for (size_t i = 0; i < display.size(); ++i) {
    for (int channel = 0; channel < 3; ++channel) bytes.push_back(SrgbByte(display[i][channel]));
    if (channels == 4) bytes.push_back(static_cast<uint8_t>(std::lround(255 * alpha[i])));
  }
  std::string png;
  stbi_write_png_to_func(AppendBytes, &png, width, height, channels, bytes.data(),
                         channels * width);
  return png;
}

}  // namespace lambert

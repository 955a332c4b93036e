#include "radiosity/output/lightmap_image.h"

#include <stb/stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "radiosity/output/png.h"

namespace lambert {
namespace {

constexpr double kShareUnder = 0.999;

double ChooseIntensity(const TexelPage& page, const TexelValues& irradiance_lx) {
  std::vector<float> largest;
  for (size_t i = 0; i < irradiance_lx.size(); ++i) {
    if (page.texels[i].patch == kNoPatch) continue;
    largest.push_back(*std::max_element(irradiance_lx[i].begin(), irradiance_lx[i].end()));
  }
  if (largest.empty()) return 1;
  const auto at = largest.begin() + static_cast<std::ptrdiff_t>(
                                        kShareUnder * static_cast<double>(largest.size() - 1));
  std::nth_element(largest.begin(), at, largest.end());
  return *at > 0 ? *at : 1;
}

}  // namespace

LightmapImages EncodeLightmapImages(const TexelPage& page, const TexelValues& irradiance_lx) {
  LightmapImages images;
  images.intensity = ChooseIntensity(page, irradiance_lx);
  std::vector<float> values;
  std::vector<uint8_t> codes;
  for (const std::array<float, 3>& texel : irradiance_lx) {
    for (const float irradiance : texel) {
      const double value = irradiance / images.intensity;
      values.push_back(static_cast<float>(value));
      codes.push_back(static_cast<uint8_t>(std::lround(255 * std::clamp(value, 0.0, 1.0))));
    }
  }
  stbi_write_hdr_to_func(AppendBytes, &images.rgbe, page.width, page.height, 3, values.data());
  stbi_write_png_to_func(AppendBytes, &images.png, page.width, page.height, 3, codes.data(),
                         3 * page.width);
  return images;
}

}  // namespace lambert

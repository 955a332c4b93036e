#include "radiosity/output/exposure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace lambert {
namespace {

constexpr double kMiddleGray = 0.26;   // display value of the geometric mean: sRGB 140
constexpr double kBrightLimit = 0.7;   // display value that 95 % of the lit picture stay under
constexpr double kEmittedLevel = 0.8;  // of the brightest emitter, where nothing reflects
// Pixels darker than this part of the brightest do not count as lit.
constexpr double kLitShare = 1e-4;

constexpr double kSaturation = 1.2;  // luminance of white at EV 0 [cd/m2]

// The least display value of each sRGB code but 0: where the code before it ends.
std::array<double, 255> MakeLeastOfCodes() {
  std::array<double, 255> least;
  for (int code = 1; code < 256; ++code) {
    const double encoded = (code - 0.5) / 255;
    least[code - 1] =
        encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
  }
  return least;
}

constexpr double kRollOffStart = 0.8;
constexpr double kDesaturation = 0.15;

std::vector<double> LitLuminances(const std::vector<Rgb>& values) {
  double brightest = 0;
  for (const Rgb& value : values) brightest = std::max(brightest, Luminance(value));
  std::vector<double> lit;
  for (const Rgb& value : values) {
    const double luminance = Luminance(value);
    if (luminance > kLitShare * brightest) lit.push_back(luminance);
  }
  return lit;
}

}  // namespace

const char* ToneMapName(ToneMap tone_map) {
  return tone_map == ToneMap::kFilmic ? "filmic" : "linear";
}

double Ev100Of(double exposure_per_lm_per_m2) {
  return -std::log2(kSaturation * std::numbers::pi * exposure_per_lm_per_m2);
}

double ExposureOfEv100(double ev100) {
  return std::exp2(-ev100) / (kSaturation * std::numbers::pi);
}

Exposure ChooseExposure(const std::vector<Rgb>& reflected, const std::vector<Rgb>& emitted) {
  std::vector<double> lit = LitLuminances(reflected);
  if (lit.empty()) {
    lit = LitLuminances(emitted);
    if (lit.empty()) return {};
    return {kEmittedLevel / *std::max_element(lit.begin(), lit.end())};
  }
  double log_sum = 0;
  for (double luminance : lit) log_sum += std::log(luminance);
  const double geometric_mean = std::exp(log_sum / static_cast<double>(lit.size()));
  const auto p95 =
      lit.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(lit.size() - 1));
  std::nth_element(lit.begin(), p95, lit.end());
  const double exposure = std::min(kMiddleGray / geometric_mean, kBrightLimit / *p95);
  return {std::min(exposure, std::numeric_limits<double>::max())};
}

Rgb Develop(Rgb radiosity_lm_per_m2, const Exposure& exposure) {
  constexpr double kBrightest = 1e6;  // whiter than white: keeps what follows finite
  Rgb value = radiosity_lm_per_m2 * exposure.per_lm_per_m2;
  for (int channel = 0; channel < 3; ++channel) {
    value[channel] = std::clamp(value[channel], 0.0, kBrightest);
  }
  if (exposure.tone_map == ToneMap::kLinear) {
    return {std::min(value.r, 1.0), std::min(value.g, 1.0), std::min(value.b, 1.0)};
  }
  const double peak = std::max({value.r, value.g, value.b});
  if (peak <= kRollOffStart) return value;
  const double room = 1 - kRollOffStart;
  const double new_peak = 1 - room * room / (peak + room - kRollOffStart);
  const double white_share = 1 - 1 / (kDesaturation * (peak - new_peak) + 1);
  value = value * (new_peak / peak);
  return value * (1 - white_share) + Rgb{new_peak, new_peak, new_peak} * white_share;
}

uint8_t SrgbByte(double display) {
  static const std::array<double, 255> least = MakeLeastOfCodes();
  return static_cast<uint8_t>(std::upper_bound(least.begin(), least.end(), display) -
                              least.begin());
}

}  // namespace lambert

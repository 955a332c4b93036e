#include "radiosity/output/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "radiosity/output/exposure.h"

namespace lambert {
namespace {

constexpr double kMostDecades = 2;
constexpr std::array<double, 3> kSteps = {1, 2, 5};

// All 1, 2, 5 times powers of ten from below `low` to above `high`.
std::vector<double> RoundNumbers(double low, double high) {
  std::vector<double> numbers;
  for (double decade = std::floor(std::log10(low)); decade <= std::log10(high) + 1; ++decade) {
    for (double step : kSteps) numbers.push_back(step * std::pow(10.0, decade));
  }
  return numbers;
}

double SrgbToLinear(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

}  // namespace

double LuxScale::Place(double irradiance_lx) const {
  if (!(irradiance_lx > low_lx)) return 0;
  return std::min(1.0, std::log(irradiance_lx / low_lx) / std::log(high_lx / low_lx));
}

LuxScale ChooseLuxScale(const Picture& picture) {
  std::vector<double> seen;
  for (size_t pixel = 0; pixel < picture.patch.size(); ++pixel) {
    const double irradiance = Luminance(picture.irradiance_lx[pixel]);
    if (picture.patch[pixel] != kNoPatch && irradiance > 0) seen.push_back(irradiance);
  }
  if (seen.empty()) return {1, 100, {1, 2, 5, 10, 20, 50, 100}};
  std::sort(seen.begin(), seen.end());
  auto rank = [&](double share) {
    return seen[static_cast<size_t>(share * static_cast<double>(seen.size() - 1))];
  };
  const double high = rank(0.99);
  const double low = std::clamp(rank(0.03), high * std::pow(10.0, -kMostDecades), high / 5);
  LuxScale scale;
  std::vector<double> numbers = RoundNumbers(low, high);
  const auto above = std::lower_bound(numbers.begin(), numbers.end(), high);
  auto below = std::upper_bound(numbers.begin(), numbers.end(), low);
  if (below != numbers.begin()) --below;
  scale.ticks_lx.assign(below, above + 1);
  scale.low_lx = scale.ticks_lx.front();
  scale.high_lx = scale.ticks_lx.back();
  return scale;
}

Rgb FalseColor(double place) {
  // Polynomials of degree 5 in the place, sRGB values 0..1.
  constexpr std::array<std::array<double, 6>, 3> kTurbo = {{
      {0.13572138, 4.61539260, -42.66032258, 132.13108234, -152.94239396, 59.28637943},
      {0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604},
      {0.10667330, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973},
  }};
  Rgb color;
  for (int channel = 0; channel < 3; ++channel) {
    double value = 0;
    for (size_t power = 6; power-- > 0;) value = value * place + kTurbo[channel][power];
    color[channel] = SrgbToLinear(std::clamp(value, 0.0, 1.0));
  }
  return color;
}

std::vector<Rgb> FalseColorPicture(const Picture& picture, const LuxScale& scale) {
  std::vector<Rgb> display = picture.display;
  for (size_t pixel = 0; pixel < display.size(); ++pixel) {
    if (picture.patch[pixel] == kNoPatch) continue;
    display[pixel] = FalseColor(scale.Place(Luminance(picture.irradiance_lx[pixel])));
  }
  return display;
}

}  // namespace lambert

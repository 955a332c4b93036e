// A value per linear Rec. 709 channel: reflectance (0..1), exitance (lm/m2), flux (lm) and so on.
#pragma once

#include <cmath>

namespace lambert {

struct Rgb {
  double r = 0, g = 0, b = 0;
  double& operator[](int channel) { return channel == 0 ? r : channel == 1 ? g : b; }
  double operator[](int channel) const { return channel == 0 ? r : channel == 1 ? g : b; }
  bool operator==(const Rgb&) const = default;
};

inline Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Rgb operator-(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
inline Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline Rgb operator*(Rgb a, double s) { return {a.r * s, a.g * s, a.b * s}; }
inline Rgb operator/(Rgb a, double s) { return {a.r / s, a.g / s, a.b / s}; }

inline Rgb Abs(Rgb a) { return {std::fabs(a.r), std::fabs(a.g), std::fabs(a.b)}; }
inline double ChannelSum(Rgb a) { return a.r + a.g + a.b; }

// The scalar that error measures use: the plain mean of the channels.
inline double Mean(Rgb a) { return (a.r + a.g + a.b) / 3; }
inline bool IsFinite(Rgb a) {
  return std::isfinite(a.r) && std::isfinite(a.g) && std::isfinite(a.b);
}

}  // namespace lambert

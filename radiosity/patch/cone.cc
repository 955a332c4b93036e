#include "radiosity/patch/cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lambert {
namespace {

// Cube root of 0 <= x <= 1 by Newton's steps, which libm would not round alike everywhere. The
// start is at most 2^(53 / 12) times too large, and each step takes off a third until it is near.
double CubeRoot(double x) {
  if (!(x > 0)) return 0;
  double root = std::sqrt(std::sqrt(x));
  for (int step = 0; step < 16; ++step) root = (2 * root + x / (root * root)) / 3;
  return root;
}

}  // namespace

Cone::Cone(double cos_inner, double cos_outer) : inner_(cos_inner), outer_(cos_outer) {
  cap_ = std::max(0.0, 1 - inner_);
  const double width = inner_ - outer_;
  if (!(width > 0)) return;
  rim_ = std::min(1.0, (1 - outer_) / width);
  fall_ = width / 3 * rim_ * rim_ * rim_;
}

double Cone::Factor(double cosine) const {
  if (cosine >= inner_) return 1;
  if (cosine <= outer_) return 0;
  const double part = (cosine - outer_) / (inner_ - outer_);
  return part * part;
}

double Cone::SolidAngle() const { return 2 * std::numbers::pi * (cap_ + fall_); }

double Cone::SampleCosine(double u) const {
  const double down = u * (cap_ + fall_);
  if (down <= cap_) return 1 - down;
  return outer_ + (inner_ - outer_) * rim_ * CubeRoot((cap_ + fall_ - down) / fall_);
}

}  // namespace lambert

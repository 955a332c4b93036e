#include "radiosity/pyramid/concentric_grid.h"

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {

// 4/pi atan(x) for |x| <= 1, by a polynomial (AS64, 4.4.47); error under 2e-5.
double QuarterTurns(double x) {
  const double x2 = x * x;
  return 1.2732395447351628 * x *
         (0.9998660 + x2 * (-0.3302995 + x2 * (0.1801410 + x2 * (-0.0851330 + x2 * 0.0208351))));
}

}  // namespace

int ConcentricGrid::Locate(Vec3 d) const {
  if (!(d.z >= 0)) return -1;
  const double across2 = d.x * d.x + d.y * d.y;
  const double radius = across2 > 0 ? std::sqrt(across2 / (across2 + d.z * d.z)) : 0.0;
  double a = 0, b = 0;  // in the square -1 .. 1
  if (std::abs(d.x) > std::abs(d.y)) {
    a = std::copysign(radius, d.x);
    b = a * QuarterTurns(d.y / d.x);
  } else if (d.y != 0) {
    b = std::copysign(radius, d.y);
    a = b * QuarterTurns(d.x / d.y);
  }
  const auto index = [this](double t) {
    return std::clamp(static_cast<int>((t + 1) * 0.5 * side_), 0, side_ - 1);
  };
  return index(b) * side_ + index(a);
}

}  // namespace lambert

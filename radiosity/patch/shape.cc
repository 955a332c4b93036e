#include "radiosity/patch/shape.h"

#include <algorithm>
#include <limits>

namespace lambert {

Shape Measure(const std::array<Vec3, 3>& corners) {
  const Vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
  return {std::max({Length(ab), Length(ac), Length(corners[2] - corners[1])}),
          Length(Cross(ab, ac)) / 2};
}

bool IsDegenerate(const std::array<Vec3, 3>& corners, const Shape& shape) {
  const double farthest_m = std::max({Length(corners[0]), Length(corners[1]), Length(corners[2])});
  const double rounding_m = 4 * std::numeric_limits<double>::epsilon() * farthest_m;
  return !(shape.area_m2 > rounding_m * shape.longest_edge_m);
}

}  // namespace lambert

// Size of a triangle, and whether it has one.
#pragma once

#include <array>

#include "radiosity/core/vec3.h"

namespace lambert {

struct Shape {
  double longest_edge_m = 0;
  double area_m2 = 0;
};

Shape Measure(const std::array<Vec3, 3>& corners);

// True where a triangle is a line or a point up to the rounding of its corners, which are relative
// to the origin of their scene: moving a corner by its last bits changes the area by that much
// times the longest edge. Slivers of one part in 1e12 are thicker than that and are none. No length
// is absolute: scenes of every size are treated alike.
bool IsDegenerate(const std::array<Vec3, 3>& corners, const Shape& shape);

}  // namespace lambert

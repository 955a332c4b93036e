// Area that two triangles of one plane share.
#pragma once

#include <array>

#include "radiosity/core/vec3.h"

namespace lambert {

// Area of the part of triangle `b` that lies over triangle `a`, seen along a's normal [square of
// the corners' unit]: 0 where they share an edge or nothing, up to rounding. Either winding; b need
// not lie in a's plane. Requires: a has area.
double OverlapArea(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace lambert

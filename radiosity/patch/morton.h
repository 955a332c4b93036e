// Z-order of points: near in the order means near in space.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/core/vec3.h"

namespace lambert {

// 63-bit Morton codes of `points`, 21 bits an axis, on a grid over their bounding cube (the same
// cell size along every axis). Requires: finite points.
std::vector<uint64_t> MortonCodes(const std::vector<Vec3>& points);

}  // namespace lambert

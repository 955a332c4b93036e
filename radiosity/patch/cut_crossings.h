// Triangles that pass through others, or that others stand on, cut where they do: light that
// arrives on one side of a wall must not leave on the other.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "radiosity/core/vec3.h"
#include "radiosity/patch/split.h"

namespace lambert {

// The pieces of triangles that are cut, by their number in `triangles`; each cut triangle is
// covered once. A triangle is cut where another one's inside or edge meets its inside, along that
// one's plane; triangles that only touch at their edges are none. Neighbours along an edge are cut
// at the same points of it. Lengths under a millionth of the scene's diagonal are none. The largest
// triangles are cut first, until there are `most_pieces`, or a triangle's more; one that more than
// 1000 others meet is cut by 1000 of them. Deterministic. N log N and the pairs whose boxes meet.
std::map<int64_t, std::vector<SplitPiece>> CutCrossings(
    const std::vector<std::array<Vec3, 3>>& triangles, int64_t most_pieces);

}  // namespace lambert

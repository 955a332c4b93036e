// Closed rooms that no light reaches.
#pragma once

#include <vector>

#include "radiosity/patch/patch_set.h"

namespace lambert {

// For each patch, whether it is the wall of a closed room without a light: the inside of a box
// whose sides are two-sided, or a dark room next door. Sides of one node that meet edge to edge
// form a room where each edge belongs to just two of them, the other way round, and where they face
// inward on the whole; it is lit where one of them emits, or where the box of a patch that emits or
// a point light reaches inside its box. Walls that meet otherwise (with gaps, T-junctions, in
// several nodes) make no room, and what stands in a room is no wall of it. Only a shell that cuts
// through itself is taken for a room where light may reach it. N log N in the patches of rooms; the
// others cost one look.
std::vector<bool> FindUnlitWalls(const PatchSet& patches);

}  // namespace lambert

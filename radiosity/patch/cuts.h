// How a scene's triangles are cut where light needs it, beside PatchOptions::max_edge_m.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "radiosity/patch/edge_marks.h"
#include "radiosity/patch/split.h"

namespace lambert {

struct Cuts {
  // The pieces of triangles that others pass through (cut_crossings.h), by the number of the
  // triangle in the order of the scene; before anything else is split.
  std::map<int64_t, std::vector<SplitPiece>> crossed = {};
  // Edges that are halved, one level after the other, each of the patches that the one before left.
  std::vector<EdgeMarks> levels = {};
};

}  // namespace lambert

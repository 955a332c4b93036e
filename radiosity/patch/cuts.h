// How a scene's triangles are cut where light needs it, beside PatchOptions::max_edge_m.
#pragma once

#include <vector>

#include "radiosity/patch/edge_marks.h"

namespace lambert {

struct Cuts {
  // Edges that are halved, one level after the other, each of the patches that the one before left.
  std::vector<EdgeMarks> levels;
};

}  // namespace lambert

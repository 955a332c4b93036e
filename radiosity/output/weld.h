// Corners of patches that are the same point.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"

namespace lambert {

struct WeldedCorners {
  int32_t vertex_count = 0;
  std::vector<std::array<int32_t, 3>> vertex;  // by patch and corner: 0 .. vertex_count - 1
};

// Joins corners that are nearer to each other than one millionth of the scene's diagonal: exporters
// round the shared vertices of neighbouring meshes differently in their last float32 bits.
WeldedCorners WeldCorners(const PatchSet& patches);

}  // namespace lambert

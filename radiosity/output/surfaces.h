// Irradiance per surface: what a lighting designer looks up first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solution.h"

namespace lambert {

// The patches of one glTF node. Irradiance: luminance of the channels [lx].
struct Surface {
  std::string name;  // of the node, or "node 7"
  int64_t patches = 0;
  double area_m2 = 0;
  double mean_lx = 0;                // weighted by area
  double least_lx = 0, most_lx = 0;  // over its patches
  double mean_reflectance = 0;       // weighted by area
};

// Largest area first.
std::vector<Surface> ListSurfaces(const PatchSet& patches, const Solution& solution);

}  // namespace lambert

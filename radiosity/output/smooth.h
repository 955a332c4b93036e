// Irradiance of patches, carried over to their corners, so that pictures show no facets.
//
// Two patches are neighbours at a corner where they share an edge that ends there, wind it in
// opposite directions (they show the same side), turn by less than kSmoothAngle, and see each other
// near the corner: a ray just above the surface is free. The value of a corner is the mean over its
// fan: the patches around that vertex that are connected through neighbours, each weighted by its
// area. A partition that stands on a floor, with or without vertices of its own there, parts the
// fans: light never leaks under it.
//
// Furniture often stands on a part of a patch, where no light arrives: the rest of the patch has
// the more, irradiance / exposed share, and what can be seen of it takes that. A corner that a
// partition cuts off from the centre of its patch keeps the patch's value (survey.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/output/survey.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Which corners share one value. Depends on the geometry alone.
struct CornerFans {
  int32_t fan_count = 0;
  std::vector<std::array<int32_t, 3>> fan;  // by patch and corner: 0 .. fan_count - 1
  std::vector<PatchSurvey> survey;          // by patch
};

// Requires: `scene` was made of `patches`.
CornerFans FindCornerFans(const PatchSet& patches, const RayScene& scene);

// Irradiance at the corners of every patch. Requires: fans of these patches; one value a patch.
std::vector<std::array<Rgb, 3>> SmoothIrradiance(const PatchSet& patches, const CornerFans& fans,
                                                 const std::vector<Rgb>& irradiance_lx);

}  // namespace lambert

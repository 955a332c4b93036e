// Values of patches, carried over to their corners, so that pictures show no facets.
//
// Two patches are neighbours where they share an edge, wind it in opposite directions (they show the
// same side), turn by less than kSmoothAngle, and see each other: a ray just above the surface from
// one centre to the other is free. A partition that stands on a floor blocks it, with or without
// vertices of its own in the floor, so light never leaks under it. The value of a corner is the mean
// over its fan: the patches around that vertex that are connected through neighbours, each weighted
// by its angle at the vertex.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Largest angle between the normals of patches that are smoothed as one surface [degrees]. A prism
// of 18 sides and more reads as a cylinder; the edges of furniture and rooms stay sharp.
inline constexpr double kSmoothAngle = 20;

// Corners that share one value.
struct CornerFans {
  int32_t fan_count = 0;
  std::vector<std::array<int32_t, 3>> fan;  // by patch and corner: 0 .. fan_count - 1
};

// Requires: `scene` was made of `patches`.
CornerFans FindCornerFans(const PatchSet& patches, const RayScene& scene);

// Mean of `values` (by patch) over each fan. Requires: fans of these patches.
std::vector<Rgb> AverageOverFans(const PatchSet& patches, const CornerFans& fans,
                                 const std::vector<Rgb>& values);

}  // namespace lambert

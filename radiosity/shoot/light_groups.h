// Which patches exchange light: the parts of a scene that no light passes between.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Rays that finding the groups of so many patches takes.
int64_t LightGroupRays(PatchIndex patches);

// The number of each patch's group, 0, 1, ... in order of the groups' first patches. Two patches
// are in one group where a ray went from one to the other, directly or by way of others; a patch of
// which no ray met another is a group alone. Found by 16 to 1024 cosine rays of every patch, always
// the same ones: what less light than that passes between may be told apart. `scene` is of
// `patches`.
std::vector<int32_t> FindLightGroups(const PatchSet& patches, const RayScene& scene);

}  // namespace lambert

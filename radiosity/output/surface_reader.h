// What surfaces reflect and emit at their points; a patch holds the means alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "radiosity/lightmap/lightmap.h"
#include "radiosity/lightmap/placed_scene.h"
#include "radiosity/patch/patch_material.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// Reads textures and vertex colours. Immutable; its arguments must outlive it.
class SurfaceReader {
 public:
  // A null scene: patches show their means. Requires: patches that were built of that scene.
  SurfaceReader(const PatchSet& patches, const Scene* scene);

  // At a point of patch i, by the weights of its corners; nothing where alpha mode MASK cuts the
  // surface away.
  std::optional<TexelSurface> At(PatchIndex i, Vec3 weights) const;

 private:
  const PatchSet& patches_;
  const Scene* const scene_;
  PlacedScene placed_;
  std::vector<int32_t> triangle_;  // by patch; empty: no surface varies
  std::vector<PatchMaterial> materials_;
};

}  // namespace lambert

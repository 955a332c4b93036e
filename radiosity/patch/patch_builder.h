// Placed triangles in, sorted patches out.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/patch/cuts.h"
#include "radiosity/patch/patch_material.h"
#include "radiosity/patch/place.h"
#include "radiosity/patch/split.h"
#include "radiosity/patch/texture_mean.h"

namespace lambert {

// SCENE_TOO_LARGE: more than `most` patches.
absl::Status TooManyPatches(int64_t most);

// "node 1, mesh 2, primitive 0, triangle 7".
std::string Where(const PatchSource& source);

// Collects the front sides of triangles in the order of the scene, then makes the sorted set.
class PatchBuilder {
 public:
  // `expected_patches`: at least about how many there will be; textures are sampled the finer, the
  // fewer. Materials, textures, options and cuts must outlive the builder.
  PatchBuilder(const std::vector<PatchMaterial>& materials, const std::vector<Texture>& textures,
               const PatchOptions& options, const Cuts& cuts, double expected_patches);

  // Splits one triangle, averages its textures and leaves out the patches that alpha mode MASK cuts
  // away by more than half. Without area it is only counted. SceneError for texture coordinates
  // that are missing or not finite; SCENE_TOO_LARGE.
  absl::Status Add(const PlacedTriangle& placed);

  // Corners, materials, twins and sources of all patches in Morton order, and warnings
  // ZERO_AREA_PATCHES, CROSSING_PATCHES, PARTLY_CUT_PATCHES and DUPLICATE_PATCHES. The builder is
  // used up.
  PatchSet Finish();

  int64_t degenerate() const { return degenerate_; }  // triangles without area
  int64_t cut() const { return cut_; }                // patches that alpha mode MASK left out
  int64_t omitted() const { return omitted_; }        // triangles of materials that are left out

 private:
  absl::Status AddPiece(const PlacedTriangle& placed, const SplitPiece& piece);
  // The piece with texture `use` on it; without one, white.
  absl::StatusOr<PaintedTriangle> Paint(const PlacedTriangle& placed, const SplitPiece& piece,
                                        const TextureUse& use) const;
  // Copies front `front`, and its back where it is two-sided, to the end of `sorted`.
  void Append(PatchIndex front, PatchSet* sorted) const;

  const std::vector<PatchMaterial>& materials_;
  const std::vector<Texture>& textures_;
  const PatchOptions& options_;
  const Cuts& cuts_;
  const int samples_per_edge_;
  std::vector<SplitPiece> pieces_;  // of the triangle in hand
  PatchSet fronts_;                 // twin: kNoPatch, or 0 where there is a back to make
  int64_t triangles_ = 0;           // that were added
  int64_t patches_ = 0;             // backs included
  int64_t degenerate_ = 0, omitted_ = 0;
  int64_t cut_ = 0, partly_cut_ = 0;
};

}  // namespace lambert

// Scene -> PatchSet.
#pragma once

#include "absl/status/statusor.h"
#include "radiosity/patch/cuts.h"
#include "radiosity/patch/light_options.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/scene/scene.h"

namespace lambert {

enum class EmissionUnit { kNit, kWattPerM2PerSr };
enum class Blend { kOpaque, kOmit };  // what becomes of materials of alpha mode BLEND

struct PatchOptions {
  double max_edge_m = 0;   // longest edge of a patch after splitting; 0: triangles as they are
  bool two_sided = false;  // true: every triangle is two-sided, whatever its material says
  EmissionUnit emission_unit = EmissionUnit::kNit;  // unit of the file's emission; W/m2/sr: the
                                                    // solution is radiometric (W in place of lm)
  double metres_per_unit = 1;                       // of the file's lengths, > 0; glTF's are metres
  Blend blend = Blend::kOpaque;                     // warned of either way (ALPHA_BLEND)
  int64_t max_patches = 20'000'000;                 // more: SCENE_TOO_LARGE
  LightOptions lights = {};                         // beside those of the file
  // Up to how many patches the solver may split where light needs it (solve/adapt_mesh.h), >= 0; 0:
  // it splits none. BuildPatches does not look at it.
  int64_t adapt_patches = 0;
  // INVALID_ARGUMENT (reason FIELD_INVALID) naming the field that is out of range.
  absl::Status Validate() const;
};

// Scales lengths to metres, splits, transforms (in double, recentred), drops triangles of no area
// and exact copies of others (counted in warnings ZERO_AREA_PATCHES and DUPLICATE_PATCHES) and
// patches of which alpha mode MASK leaves less than half (those partly cut are counted in
// PARTLY_CUT_PATCHES), averages textures over each patch, and sorts. Exitance is pi times the
// luminance in either emission unit: the unit says how to read the results, and nothing is
// multiplied by 683 on the way. Reflectance over 1 is clamped with a warning (REFLECTANCE_CLAMPED),
// over .95 warned of (REFLECTANCE_HIGH); values that are not finite are refused by name. Patches
// that lie on one another are named (COPLANAR_OVERLAP). No emitter at all: warning NO_EMITTERS. No
// triangle left: SceneError with reason NO_TRIANGLES. Where edges are marked that no patch has,
// nothing happens to them.
absl::StatusOr<PatchSet> BuildPatches(const Scene& scene, const PatchOptions& options,
                                      const Cuts& cuts = {});

// Cuts with the `crossed` triangles of a scene that BuildPatches accepts, about `most_pieces` of
// them, and no levels.
Cuts FindCrossings(const Scene& scene, const PatchOptions& options, int64_t most_pieces);

}  // namespace lambert

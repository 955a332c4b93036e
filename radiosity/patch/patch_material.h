// Materials as patches need them: checked, clamped and in radiosity's quantities.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/scene.h"

namespace lambert {

struct PatchMaterial {
  Rgb reflectance;                 // 0..1, multiplies texture and vertex colours
  TextureUse reflectance_texture;  // of the scene
  Rgb exitance_lm_per_m2;          // pi * luminance, multiplies the texture
  TextureUse exitance_texture;
  bool two_sided = false;
  bool omitted = false;  // IsOmitted's
  // Where alpha times those of texture and colours is under the cutoff, there is no surface.
  double alpha = 1, alpha_cutoff = 0;
};

// Whether surfaces of the material are left out: alpha mode BLEND where that is.
inline bool IsOmitted(const Material& material, const PatchOptions& options) {
  return material.blend && options.blend == Blend::kOmit;
}

// One for each material of the scene, at index material + 1; index 0 is glTF's default material.
// Reflectance over 1 becomes 1 (warning REFLECTANCE_CLAMPED); alpha mode BLEND is named
// (ALPHA_BLEND). What is negative or not finite is refused with SceneError naming the material. A
// texture of which nothing shows is left out.
absl::StatusOr<std::vector<PatchMaterial>> MakePatchMaterials(const Scene& scene,
                                                              const PatchOptions& options,
                                                              std::vector<Warning>* warnings);

}  // namespace lambert

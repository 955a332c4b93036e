// Materials as patches need them: checked, clamped and in radiosity's quantities.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/scene/scene.h"

namespace lambert {

struct PatchMaterial {
  Rgb reflectance;                               // 0..1, multiplies the texture
  const Texture* reflectance_texture = nullptr;  // points into the scene
  int reflectance_uv = 0;
  Rgb exitance_lm_per_m2;  // pi * luminance, multiplies the texture
  const Texture* exitance_texture = nullptr;
  int exitance_uv = 0;
  bool two_sided = false;
  // Texels of less alpha than this are cut away (alpha mode MASK); 0: none, 256: all. Where there
  // is no texture, alpha is 255.
  int least_alpha = 0;
  const Texture* alpha_texture = nullptr;  // with the coordinates of the reflectance
};

// One for each material of the scene, at index material + 1; index 0 is glTF's default material.
// Reflectance over 1 becomes 1 (warning REFLECTANCE_CLAMPED). What is negative or not finite is
// refused with SceneError naming the material. A texture whose factor is zero is left out.
absl::StatusOr<std::vector<PatchMaterial>> MakePatchMaterials(const Scene& scene,
                                                              bool all_two_sided,
                                                              std::vector<Warning>* warnings);

}  // namespace lambert

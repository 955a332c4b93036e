#include "radiosity/patch/patch_material.h"

#include <algorithm>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

bool IsNegative(Rgb a) { return a.r < 0 || a.g < 0 || a.b < 0; }

absl::Status CheckFactor(Rgb factor, size_t material, const char* what) {
  const std::string where = absl::StrCat("material ", material);
  if (!IsFinite(factor)) {
    return SceneError(where, absl::StrCat(what, " is not finite"), "give it a finite value");
  }
  if (IsNegative(factor)) {
    return SceneError(where, absl::StrCat(what, " is negative"), "give it a value of 0 or more");
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::vector<PatchMaterial>> MakePatchMaterials(const Scene& scene,
                                                              const PatchOptions& options,
                                                              std::vector<Warning>* warnings) {
  std::vector<PatchMaterial> materials(1);
  materials[0].reflectance = {1, 1, 1};
  materials[0].two_sided = options.two_sided;
  int clamped = 0, blended = 0;
  for (size_t i = 0; i < scene.materials.size(); ++i) {
    const Material& material = scene.materials[i];
    absl::Status status = CheckFactor(material.reflectance, i, "reflectance");
    // A Lambertian emitter of luminance L sends M = pi L into its half space.
    const Rgb exitance_lm_per_m2 = material.luminance * std::numbers::pi;
    if (status.ok()) status = CheckFactor(exitance_lm_per_m2, i, "emission");
    if (!status.ok()) return status;
    const Rgb rho = material.reflectance;
    PatchMaterial made;
    made.reflectance = {std::min(rho.r, 1.0), std::min(rho.g, 1.0), std::min(rho.b, 1.0)};
    if (made.reflectance != rho) ++clamped;
    if (rho != Rgb{} || material.alpha_cutoff > 0) {
      made.reflectance_texture = material.reflectance_texture;
    }
    made.exitance_lm_per_m2 = exitance_lm_per_m2;
    if (material.luminance != Rgb{}) made.exitance_texture = material.luminance_texture;
    made.two_sided = material.two_sided || options.two_sided;
    made.omitted = IsOmitted(material, options);
    if (material.blend) ++blended;
    made.alpha = material.alpha;
    made.alpha_cutoff = material.alpha_cutoff;
    materials.push_back(made);
  }
  if (clamped > 0) {
    warnings->push_back(
        {"REFLECTANCE_CLAMPED", absl::StrCat("the reflectance of ", clamped,
                                             " material(s) is over 1 and was taken as 1")});
  }
  if (blended > 0) {
    warnings->push_back(
        {"ALPHA_BLEND", absl::StrCat("alpha mode BLEND: ", blended, " material(s) ",
                                     options.blend == Blend::kOmit
                                         ? "left out; --blend opaque takes them as opaque"
                                         : "taken as opaque; --blend omit leaves them "
                                           "out")});
  }
  return materials;
}

}  // namespace lambert

// NAME.glb: the lit scene as a model that any viewer shows at once.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/output/exposure.h"
#include "radiosity/output/view.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// glTF 2.0 binary: one node and mesh for each node of the source that shows patches, under its name
// and placed by the patch set's origin; COLOR_0 is the developed radiosity (normalised uint16,
// linear) under KHR_materials_unlit; _IRRADIANCE is float VEC3 [lx]. Both sides of a two-sided
// triangle are there, each as its own one-sided triangle. A camera stands where the picture was
// taken. The extras of the asset record the exposure. RESOURCE_EXHAUSTED (reason OUTPUT_TOO_LARGE)
// where the file would pass the 4 GiB of its format. Requires: `corner_irradiance_lx` is of these
// patches.
//
// With the scene that the patches were built of, what has a base texture and does not emit, or
// emits through the same texture, keeps it: there COLOR_0 is what the texture is multiplied by.
// Where light would take that over 1, the texture is brightened by 1.4 to 16 (extras `gain`), where
// that darkens the patch less.
absl::StatusOr<std::string> EncodeGlb(const PatchSet& patches,
                                      const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
                                      const Exposure& exposure, const View& view,
                                      const Scene* scene = nullptr);

}  // namespace lambert

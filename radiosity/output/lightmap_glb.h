// NAME.lightmapped.glb: the lit scene with its light in pictures.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/lightmap/atlas_part.h"
#include "radiosity/output/exposure.h"
#include "radiosity/output/view.h"

namespace lambert {

// glTF 2.0 binary that any viewer shows at once: KHR_materials_unlit with one PNG a page of the
// atlas, on TEXCOORD_1. One node and mesh for each instance that shows patches, one primitive for
// each of `parts`; both sides of a two-sided triangle are there, each as its own one-sided
// triangle. Parts with a mask are of alpha mode MASK. A camera stands where the picture was taken.
// RESOURCE_EXHAUSTED (reason OUTPUT_TOO_LARGE) over 4 GiB. Requires: a PNG a page; parts of these.
absl::StatusOr<std::string> EncodeLightmappedGlb(const Scene& scene, const PatchSet& patches,
                                                 const Atlas& atlas,
                                                 const std::vector<AtlasPart>& parts,
                                                 const std::vector<std::string>& pngs,
                                                 const Exposure& exposure, const View& view);

}  // namespace lambert

// The files of a lightmap.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "radiosity/core/vec3.h"
#include "radiosity/gather/gather_points.h"
#include "radiosity/output/exposure.h"
#include "radiosity/output/run_record.h"
#include "radiosity/output/view.h"

namespace lambert {

// Writes STEM.lightmapped.glb, STEM.lit.glb, STEM.irradiance.exr (and -2, -3, ... for more pages)
// and STEM.lightmap.json, one after the other, as docs/formats.md says. `stem`: folder and name.
// With `gather` the light of each texel is gathered at its point; else it is linear between the
// corners of patches. Fails as `gather` does. Requires: record.scene with its appearance, and
// record.atlas; light at the corners of its patches [lx] and, with `gather`, normals there
// (gathered_light.h).
absl::Status WriteLightmap(const std::string& stem, const RunRecord& record,
                           const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
                           const Exposure& exposure, const View& view,
                           const std::vector<std::array<Vec3, 3>>& corner_normals = {},
                           const GatherFunction& gather = nullptr);

}  // namespace lambert

// The files of a lightmap.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "radiosity/output/exposure.h"
#include "radiosity/output/run_record.h"
#include "radiosity/output/view.h"

namespace lambert {

// Writes STEM.lightmapped.glb, STEM.irradiance.exr (and -2, -3, ... for more pages) and
// STEM.lightmap.json, one after the other, as docs/formats.md says. `stem`: folder and name.
// Requires: record.scene and record.atlas; light at the corners of its patches [lx].
absl::Status WriteLightmap(const std::string& stem, const RunRecord& record,
                           const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
                           const Exposure& exposure, const View& view);

}  // namespace lambert

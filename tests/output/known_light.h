// Solutions made without solving, for tests of the output.
#pragma once

#include <functional>
#include <string>

#include "radiosity/output/run_record.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solution.h"

namespace lambert {

// The solution under a given irradiance [lx] at each centroid (world metres): B = E + rho
// irradiance, a standard error of a hundredth, and a balanced ledger.
Solution LitBy(const PatchSet& patches, const std::function<Rgb(Vec3)>& irradiance_lx);

// A record of a finished run of two passes with that solution.
RunRecord RecordOf(const PatchSet& patches, const std::function<Rgb(Vec3)>& irradiance_lx);

// A new folder of this test's own under the temporary folder.
std::string TestFolder();

}  // namespace lambert

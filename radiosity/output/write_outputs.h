// The output folder of a run.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "radiosity/output/run_record.h"

namespace lambert {

// Writes patches.csv, run.json, NAME.glb, NAME.exr, NAME.png and report.html into `folder`, which
// is made if need be; each file appears whole or not at all, and an older one is replaced.
// convergence.csv is not written here: ConvergenceLog appends to it while the run goes.
// Fails with OUTPUT_FAILED naming the file (disk full, no right to write).
// Requires: record.patches and record.snapshot.solution are set and about the same patches.
absl::Status WriteOutputs(const std::string& folder, const RunRecord& record);

}  // namespace lambert

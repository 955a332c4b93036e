// The output folder of a run.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "radiosity/gather/gather_points.h"
#include "radiosity/output/run_record.h"

namespace lambert {

// The files that may be left out: what none of them needs is not computed.
struct OutputFiles {
  bool csv = true;  // patches.csv
  bool glb = true, exr = true, png = true;
  bool report = true;  // report.html
  bool NeedPicture() const { return glb || exr || png || report; }
};

// Writes run.json; sensors.csv and sensors.json where there are sensors; and of patches.csv,
// NAME.glb, NAME.exr, NAME.png and report.html those that are asked for, into `folder`, which is
// made if need be; each file appears whole or not at all, and an older one is replaced; older ones
// that are not asked for are left as they are. With an atlas in the record the files of its
// lightmap, too (lightmap_files.h). convergence.csv is not written here: ConvergenceLog appends to
// it while the run goes. Fails with OUTPUT_FAILED naming the file (disk full, no right to write).
// With `gather`, the light of pictures, of NAME.glb and of lightmaps is gathered at their own
// points; patches.csv stays the solution's. Fails as `gather` does. Requires: record.patches and
// record.snapshot.solution are set and about the same patches; with record.atlas, record.scene.
absl::Status WriteOutputs(const std::string& folder, const RunRecord& record,
                          const OutputFiles& files = {}, const GatherFunction& gather = nullptr);

}  // namespace lambert

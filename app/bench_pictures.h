// What the same number of rays looks like by each method, as in figures 11 to 13 of the paper.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "app/bench_scene.h"

namespace lambert::app {

// Writes into `folder` (made if need be) for the reference and for each method at the smallest
// budget, first seed: METHOD_whole.png, as the scene's camera sees it, and METHOD_detail.png, the
// region seen near or the middle three times as large. Patches are flat and the exposure is the
// same, so that what differs is noise. gnuplot mounts them with their names in methods.png.
// Returns the path of that; errors as DrawFigures.
absl::StatusOr<std::vector<std::string>> DrawPictures(const BenchResult& result,
                                                      const std::string& folder);

}  // namespace lambert::app

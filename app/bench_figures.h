// Figures of a bench, drawn by gnuplot: error against rays and time, what the methods cost.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "app/bench_scene.h"

namespace lambert::app {

// Writes into `folder` (made if need be) the data (errors.dat, costs.dat), a script for each figure
// and what gnuplot makes of it, NAME.svg and NAME.png:
//   error_rays, error_time   rms_area and rms_patch, and rms_local with a region; logarithmic, with
//                            a guide of slope -1/2 and the residual of the reference
//   figure9, figure10        rms_patch, and rms_local, against rays as in the paper (JPS00)
//   costs                    memory, time to the first rays, CPU time of a ray, at the largest
//                            budget
// Returns the pictures' paths. OUTPUT_FAILED where a file cannot be written; GNUPLOT_FAILED where
// gnuplot is not there or does not like the script: data and scripts are left to draw them later.
absl::StatusOr<std::vector<std::string>> DrawFigures(const BenchResult& result,
                                                     const std::string& folder);

}  // namespace lambert::app

// Statistics over the runs of a bench: what several seeds of one method at one budget say together.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "radiosity/output/agreement.h"
#include "radiosity/output/compare.h"
#include "radiosity/solve/solution.h"

namespace lambert {

// One finished run.
struct BenchRun {
  std::string method;  // as the user wrote it: "phs:depth=3"
  std::string budget;  // "200000" rays, or "2s"
  uint64_t seed = 0;
  Progress progress;                      // at its end
  ErrorMeasures measures;                 // of its last snapshot
  Deviations deviations;                  // of the same
  double setup_s = 0;                     // from asking for the job to its first rays, seconds
  int64_t planned_worker_bytes = 0;       // what the plan says that one worker takes
  std::optional<int64_t> peak_rss_bytes;  // of this process during the run, where all is in it
};

// All seeds of one method at one budget.
struct BenchSummary {
  std::string method, budget;
  int seeds = 0;
  double rays = 0, seconds = 0, cpu_seconds = 0, setup_s = 0;  // means over the seeds
  int64_t planned_worker_bytes = 0;                            // largest
  std::optional<int64_t> peak_rss_bytes;                       // largest
  // rms_*: root of the mean square. p95 and power_bias: means.
  ErrorMeasures measures;
  std::optional<double> power_bias_se;        // standard error of that mean; with two seeds or more
  std::optional<Agreement> agreement;         // empty where no patch has enough hits
  std::optional<double> estimated_rms_area;   // root of the mean square of the runs' own estimates
  std::optional<double> estimated_over_true;  // that over measures.rms_area
  // How many times less this method needs for the same error than the first method at this budget:
  // ratios of error^2 * rays, and of error^2 * CPU seconds. Over 1 is better.
  std::optional<double> per_ray_area, per_ray_patch, per_cpu_area, per_cpu_patch;
};

// One for each method and budget, in the order in which they first appear. A measure that one seed
// lacks is empty. Requires: all deviations are from `reference`.
std::vector<BenchSummary> SummarizeRuns(const std::vector<BenchRun>& runs,
                                        const PatchTable& reference);

// summary.csv (docs/formats.md).
std::string EncodeSummaryCsv(const std::vector<BenchSummary>& summaries);

}  // namespace lambert

// The bench of one scene: its reference, then every method at every budget with every seed.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "app/bench_list.h"
#include "app/job_runner.h"
#include "app/options.h"
#include "radiosity/output/bench_summary.h"
#include "radiosity/output/convergence.h"
#include "radiosity/output/reference.h"
#include "radiosity/patch/patch_set.h"

namespace lambert::app {

// Rays of a reference that is made, over those of the largest budget.
inline constexpr int64_t kReferenceFactor = 20;

// A method that could not run here.
struct LeftOut {
  std::string label, why;
};

// What was run on one scene, and what came of it.
struct BenchResult {
  std::string name;          // of the scene, without folder and ending
  std::string folder;        // where its files are
  std::string scene_digest;  // SHA-256 of what was submitted
  std::shared_ptr<const PatchSet> patches;
  std::set<int> region_nodes;
  std::vector<Warning> warnings;

  Reference reference;
  std::shared_ptr<const Solution> reference_solution;  // by patch
  std::string reference_origin;  // for people: "pmcr, 2 halves of 50 Mrays", "read from r.csv"
  std::string reference_file;    // where it can be read the next time

  std::vector<BenchEntry> entries;  // that ran
  std::vector<LeftOut> left_out;
  std::vector<BenchRun> runs;
  std::vector<BenchSummary> summaries;
  // Of the smallest budget and the first seed, by entry; null where that run is missing.
  std::vector<std::shared_ptr<const Solution>> pictured;
  std::string pictured_budget;
  bool interrupted = false;  // by Ctrl-C: the runs are those that were finished
};

// Runs it, and writes convergence.csv as it goes, reference.csv and summary.csv into `folder`. The
// methods take turns, seed by seed and budget by budget, so that what else the machine does falls
// on all alike. A method that cannot run is left out, and is an error where it was asked for by
// name. INTERRUPTED where Ctrl-C came before the reference was there.
absl::StatusOr<BenchResult> BenchScene(const Options& options, const std::string& scene_path,
                                       const std::string& folder, Service& service,
                                       Interrupt& interrupt, ProgressPrinter& printer);

}  // namespace lambert::app

#include "app/bench_scene.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "app/light_files.h"
#include "app/measure.h"
#include "app/progress_text.h"
#include "app/result.h"
#include "app/scene_files.h"
#include "fmt/format.h"
#include "radiosity/core/error.h"
#include "radiosity/output/output_file.h"
#include "radiosity/scene/load_gltf.h"

namespace lambert::app {
namespace {

// Between the seeds of the runs and those of the reference.
constexpr uint64_t kReferenceSeed = 1'000'000;

// What makes a reference: it has to be unbiased on every scene.
Method ReferenceMethod(const PatchSet& patches) {
  return patches.size() <= kMaxExactPatches ? Method::kExact : Method::kPmcr;
}

bool IsInterrupted(const absl::Status& status) { return ReasonOf(status) == "INTERRUPTED"; }

std::string Why(const absl::Status& status) {
  const auto detail = GetErrorDetail(status);
  return detail ? detail->message + "; " + detail->hint : std::string(status.message());
}

Solution DarkSolution(const PatchSet& patches) {
  Solution dark;
  dark.radiosity_lm_per_m2.resize(patches.size());
  dark.irradiance_lx.resize(patches.size());
  dark.std_error_lm_per_m2.resize(patches.size());
  dark.hits.resize(patches.size());
  return dark;
}

class Bench {
 public:
  Bench(const Options& options, Service& service, Interrupt& interrupt, ProgressPrinter& printer)
      : options_(options),
        service_(service),
        printer_(printer),
        jobs_(service, interrupt, printer),
        budgets_(BenchBudgets(options)) {}

  absl::StatusOr<BenchResult> Run(const std::string& scene_path, const std::string& folder);

 private:
  // Reads the scene here too: for its regions, its reference and its pictures.
  absl::Status Prepare(const std::string& scene_path, const std::string& folder);
  // Asks the service which methods it would run.
  absl::Status ChooseEntries();
  absl::Status DropEntry(size_t entry, const absl::Status& why);
  absl::Status ReadReference();
  absl::Status MakeReference();
  SolveOptions HalfOfReference(uint64_t half) const;
  // By our patches, whatever the order in its file. Fails where it is of other patches.
  absl::Status SolveByReference();
  absl::Status RunAll();
  absl::Status RunOne(size_t entry, const BenchBudget& budget, uint64_t seed);
  absl::Status Finish();

  const Options& options_;
  Service& service_;
  ProgressPrinter& printer_;
  JobRunner jobs_;
  const std::vector<BenchBudget> budgets_;
  std::string scene_;  // its name on the service
  std::vector<bool> dropped_;
  std::optional<ConvergenceLog> log_;
  int done_ = 0;
  BenchResult result_;
};

absl::StatusOr<BenchResult> Bench::Run(const std::string& scene_path, const std::string& folder) {
  if (absl::Status status = Prepare(scene_path, folder); !status.ok()) return status;
  if (absl::Status status = ChooseEntries(); !status.ok()) return status;
  absl::Status made = options_.reference_path.empty() ? MakeReference() : ReadReference();
  if (!made.ok()) return made;
  if (absl::Status status = SolveByReference(); !status.ok()) return status;
  absl::Status ran = RunAll();
  result_.interrupted = IsInterrupted(ran);
  if (!ran.ok() && !result_.interrupted) return ran;
  if (absl::Status status = Finish(); !status.ok()) return status;
  return std::move(result_);
}

absl::Status Bench::Prepare(const std::string& scene_path, const std::string& folder) {
  result_.name = SceneStem(scene_path);
  result_.folder = folder;
  auto bundle = ReadLitBundle(scene_path, options_);
  if (!bundle.ok()) return bundle.status();
  if (absl::Status status = TestOutputFolder(folder); !status.ok()) return status;
  auto loaded = LoadGltf(*bundle, options_.limits);
  if (!loaded.ok()) return loaded.status();
  auto patches = BuildPatches(*loaded, options_.patch);
  if (!patches.ok()) return patches.status();
  auto regions = FindRegions(options_.regions, patches->node_names);
  if (!regions.ok()) return regions.status();
  result_.region_nodes = *std::move(regions);
  result_.warnings = patches->warnings;
  for (const Warning& warning : result_.warnings) printer_.Warn(warning);
  result_.patches = std::make_shared<const PatchSet>(*std::move(patches));
  auto submitted = service_.client->SubmitScene(*bundle, [](int64_t, int64_t) {});
  if (!submitted.ok()) return submitted.status();
  scene_ = submitted->name;
  result_.scene_digest = submitted->digest;
  auto log = ConvergenceLog::Create(folder + "/convergence.csv");
  if (!log.ok()) return log.status();
  log_.emplace(*std::move(log));
  return absl::OkStatus();
}

absl::Status Bench::ChooseEntries() {
  auto entries = ParseBenchEntries(options_.bench.methods, options_.solve);
  if (!entries.ok()) return entries.status();
  result_.entries = *std::move(entries);
  result_.pictured.resize(result_.entries.size());
  dropped_.resize(result_.entries.size());
  for (size_t entry = 0; entry < dropped_.size(); ++entry) {
    const SolveOptions solve =
        WithBudget(result_.entries[entry].solve, budgets_.front(), options_.solve.seed);
    auto plan = service_.client->PlanScene(scene_, options_.patch, solve);
    if (plan.ok()) continue;
    if (absl::Status status = DropEntry(entry, plan.status()); !status.ok()) return status;
  }
  return absl::OkStatus();
}

absl::Status Bench::DropEntry(size_t entry, const absl::Status& why) {
  const BenchEntry& dropped = result_.entries[entry];
  const bool is_about_the_method = why.code() == absl::StatusCode::kInvalidArgument ||
                                   why.code() == absl::StatusCode::kFailedPrecondition ||
                                   why.code() == absl::StatusCode::kUnimplemented;
  if (dropped.by_name || !is_about_the_method) return why;
  dropped_[entry] = true;
  std::erase_if(result_.runs, [&](const BenchRun& run) { return run.method == dropped.label; });
  result_.left_out.push_back({dropped.label, Why(why)});
  printer_.Note("left out: " + dropped.label + ": " + Why(why));
  const bool is_any_left = std::find(dropped_.begin(), dropped_.end(), false) != dropped_.end();
  return is_any_left ? absl::OkStatus() : why;
}

absl::Status Bench::ReadReference() {
  auto table = ReadPatchTable(options_.reference_path);
  if (!table.ok()) return table.status();
  auto reference = JudgeReference(*std::move(table), result_.region_nodes);
  if (!reference.ok()) return reference.status();
  result_.reference = *std::move(reference);
  result_.reference_origin = "read from " + options_.reference_path;
  result_.reference_file = options_.reference_path;
  return absl::OkStatus();
}

SolveOptions Bench::HalfOfReference(uint64_t half) const {
  BenchBudget largest;
  for (const BenchBudget& budget : budgets_) {
    largest.rays = std::max(largest.rays, budget.rays);
    largest.seconds = std::max(largest.seconds, budget.seconds);
  }
  const BenchOptions& bench = options_.bench;
  BenchBudget budget{largest.rays * kReferenceFactor / 2, 0};
  if (largest.rays == 0) budget.seconds = largest.seconds * kReferenceFactor / 2;
  if (bench.reference_rays > 0) budget = {std::max<int64_t>(1, bench.reference_rays / 2), 0};
  if (bench.reference_error > 0 && bench.reference_rays == 0) budget = {};
  SolveOptions solve = WithBudget(options_.solve, budget, options_.solve.seed);
  solve.shoot.method = ReferenceMethod(*result_.patches);
  solve.max_error = bench.reference_error * std::sqrt(2.0);  // a half's, for that of their mean
  solve.seed += kReferenceSeed + half;
  return solve;
}

absl::Status Bench::MakeReference() {
  std::vector<PatchTable> halves;
  int64_t rays = 0;
  for (uint64_t half = 0; half < 2; ++half) {
    const SolveOptions solve = HalfOfReference(half);
    printer_.Stage(fmt::format("reference, half {} of 2, method {}", half + 1,
                               MethodName(solve.shoot.method)));
    auto finished =
        jobs_.Run(scene_, options_.patch, solve, [](const Snapshot&) { return absl::OkStatus(); });
    if (!finished.ok()) return finished.status();
    rays += finished->job.snapshot_progress.rays;
    halves.push_back(MakePatchTable(*result_.patches, *finished->solution));
  }
  auto reference = JoinHalves(halves[0], halves[1], result_.region_nodes);
  if (!reference.ok()) return reference.status();
  result_.reference = *std::move(reference);
  result_.reference_origin =
      fmt::format("{}, {} in two halves", MethodName(ReferenceMethod(*result_.patches)),
                  FormatCount(static_cast<double>(rays), "rays"));
  result_.reference_file = result_.folder + "/reference.csv";
  return WritePatchTable(result_.reference_file, result_.reference.table);
}

absl::Status Bench::SolveByReference() {
  const PatchTable& table = result_.reference.table;
  auto solution = std::make_shared<Solution>(DarkSolution(*result_.patches));
  auto partner = PairPatches(MakePatchTable(*result_.patches, *solution), table);
  if (!partner.ok()) return partner.status();
  for (PatchIndex i = 0; i < result_.patches->size(); ++i) {
    const PatchIndex r = (*partner)[i];
    solution->radiosity_lm_per_m2[i] = table.radiosity_lm_per_m2[r];
    solution->irradiance_lx[i] = table.irradiance_lx[r];
    solution->std_error_lm_per_m2[i] = table.std_error_lm_per_m2[r];
  }
  result_.reference_solution = std::move(solution);
  return absl::OkStatus();
}

absl::Status Bench::RunAll() {
  const uint64_t first = options_.solve.seed;
  for (int k = 0; k < options_.bench.seeds; ++k) {
    for (const BenchBudget& budget : budgets_) {
      for (size_t entry = 0; entry < result_.entries.size(); ++entry) {
        ++done_;
        if (dropped_[entry]) continue;
        absl::Status status = RunOne(entry, budget, first + static_cast<uint64_t>(k));
        if (IsInterrupted(status)) return status;
        if (!status.ok()) status = DropEntry(entry, status);
        if (!status.ok()) return status;
      }
    }
  }
  return absl::OkStatus();
}

absl::Status Bench::RunOne(size_t entry, const BenchBudget& budget, uint64_t seed) {
  const std::string& label = result_.entries[entry].label;
  const size_t all = options_.bench.seeds * budgets_.size() * result_.entries.size();
  printer_.Stage(fmt::format("run {} of {}: {}, {}, seed {}", done_, all, label,
                             BudgetForPeople(budget), seed));
  ErrorMeasures measures;
  Deviations deviations;
  const auto measure = [&](const Snapshot& snapshot) -> absl::Status {
    const PatchTable table = MakePatchTable(*result_.patches, *snapshot.solution);
    auto measured = Compare(table, result_.reference.table, result_.region_nodes);
    if (!measured.ok()) return measured.status();
    auto deviating = DeviationsFrom(table, result_.reference.table);
    if (!deviating.ok()) return deviating.status();
    measures = *measured;
    deviations = *std::move(deviating);
    return log_->Append({label, seed, snapshot.progress, measures});
  };
  const SolveOptions solve = WithBudget(result_.entries[entry].solve, budget, seed);
  auto finished = jobs_.Run(scene_, options_.patch, solve, measure);
  if (!finished.ok()) return finished.status();
  result_.runs.push_back({label, BudgetText(budget), seed, finished->job.snapshot_progress,
                          measures, std::move(deviations), finished->setup_s,
                          finished->job.plan.worker_bytes, finished->peak_rss_bytes});
  const BenchBudget smallest = *std::min_element(
      budgets_.begin(), budgets_.end(), [](const BenchBudget& a, const BenchBudget& b) {
        return std::tie(a.rays, a.seconds) < std::tie(b.rays, b.seconds);
      });
  result_.pictured_budget = BudgetForPeople(smallest);
  if (seed == options_.solve.seed && BudgetText(budget) == BudgetText(smallest)) {
    result_.pictured[entry] = finished->solution;
  }
  return absl::OkStatus();
}

absl::Status Bench::Finish() {
  // Without those that were dropped, and without the pictures that they might have had.
  for (size_t entry = dropped_.size(); entry-- > 0;) {
    if (!dropped_[entry]) continue;
    result_.entries.erase(result_.entries.begin() + static_cast<std::ptrdiff_t>(entry));
    result_.pictured.erase(result_.pictured.begin() + static_cast<std::ptrdiff_t>(entry));
  }
  result_.summaries = SummarizeRuns(result_.runs, result_.reference.table);
  return WriteOutputFile(result_.folder + "/summary.csv", EncodeSummaryCsv(result_.summaries));
}

}  // namespace

absl::StatusOr<BenchResult> BenchScene(const Options& options, const std::string& scene_path,
                                       const std::string& folder, Service& service,
                                       Interrupt& interrupt, ProgressPrinter& printer) {
  return Bench(options, service, interrupt, printer).Run(scene_path, folder);
}

}  // namespace lambert::app

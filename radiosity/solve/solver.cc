#include "radiosity/solve/solver.h"

#include <algorithm>
#include <cmath>

#include "radiosity/core/error.h"
#include "radiosity/core/philox.h"
#include "radiosity/patch/surface_tree.h"
#include "radiosity/shoot/importance.h"
#include "radiosity/solve/allocate.h"
#include "radiosity/solve/checkpoint.h"
#include "radiosity/solve/flux_ledger.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/replicates.h"
#include "radiosity/solve/sightings.h"

namespace lambert {
namespace {

// Passes grow: few are needed for any budget, and yet enough for a standard error.
constexpr double kPassGrowth = 1.5;
constexpr int32_t kFirstPasses = 2;        // one pass has no standard error
constexpr int32_t kMinPassesForError = 3;  // before an estimated error is believed
constexpr double kBudgetMargin = 0.01;  // of the rays left: a pass's rays are known to about this
// Steps without any absorption or escape after which the flux is taken to have no way out.
constexpr int64_t kStepsWithoutLoss = 10000;

// Rays of a whole pass for each ray of its first step, before any pass has told: 1 / (1 - rho) with
// the area's mean reflectance, as in a closed scene.
double GuessRaysPerFirstRay(const PatchSet& patches) {
  CompensatedSum area, reflecting;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    area.Add(patches.area_m2[i]);
    reflecting.Add(patches.area_m2[i] * Mean(patches.reflectance[i]));
  }
  return 1 / (1 - std::min(reflecting.value() / area.value(), 0.99999));
}

// Area from which a step's rays start: of the emitters at first, of all patches when light is
// everywhere.
double ShootingArea(const PatchSet& patches, bool first_step) {
  CompensatedSum area_m2;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!first_step || !(patches.exitance_lm_per_m2[i] == Rgb{})) area_m2.Add(patches.area_m2[i]);
  }
  return std::max(area_m2.value(), 1e-300);  // point lights only
}

}  // namespace

absl::StatusOr<UnitResult> SerialExecutor::RunStep(const std::vector<WorkUnit>& units) {
  UnitResult merged;
  for (const WorkUnit& unit : units) {
    absl::StatusOr<UnitResult> result = shooter_->Run(unit);
    if (!result.ok()) return result.status();
    if (absl::Status status = CheckLedger(unit, *result); !status.ok()) return status;
    MergeResult(*result, merged);
  }
  return merged;
}

const char* StopReasonName(StopReason reason) {
  switch (reason) {
    case StopReason::kNone:
      return "none";
    case StopReason::kErrorReached:
      return "error_reached";
    case StopReason::kRaysSpent:
      return "rays_spent";
    case StopReason::kTimeSpent:
      return "time_spent";
    case StopReason::kNothingToShoot:
      return "nothing_to_shoot";
  }
  return "unknown";
}

struct Solver::State {
  State(std::shared_ptr<const PatchSet> set, const SolveOptions& solve_options,
        std::function<double()> clock)
      : patches(std::move(set)),
        options(solve_options),
        now(std::move(clock)),
        replicates(*patches),
        started(now()) {
    if (options.shoot.method == Method::kPhsHier) {
      tree = std::make_unique<const SurfaceTree>(*patches);
    }
    at.pass_rays = MakePlan(*patches, options).first_pass_rays;
    at.rays_per_first_ray = GuessRaysPerFirstRay(*patches);
    const Rgb emitted = EmittedFlux(*patches);
    if (!(emitted.r + emitted.g + emitted.b > 0)) {
      at.stop = StopReason::kNothingToShoot;
      at.unsent_fraction = 0;
    }
  }

  double Seconds() const { return at.seconds + now() - started; }
  Progress CurrentProgress() const;
  absl::Status RunOnePass(StepExecutor& executor,
                          const std::function<void(const Progress&)>& on_step);
  StepPlan PlanStep(double flux_per_ray, const FluxLedger& ledger) const;
  // One step; false where the pass is over.
  absl::StatusOr<bool> RunStep(StepExecutor& executor, double flux_per_ray, FluxLedger& ledger);
  absl::Status CheckAbsorption(const StepPlan& plan, const UnitResult& result,
                               const FluxLedger& ledger);
  void KeepPass(const FluxLedger& ledger, int64_t pass_rays, int64_t first_step_rays);
  bool TimeIsOut() const { return options.max_time_s > 0 && Seconds() >= options.max_time_s; }
  // Fills `weights` once.
  absl::Status Weigh();
  void EstimateError();
  void DecideNext();

  const std::shared_ptr<const PatchSet> patches;
  const SolveOptions options;
  const std::function<double()> now;
  Replicates replicates;
  double started;
  RunState at;                                               // where the run stands
  double estimated_rms_area = -1, estimated_rms_patch = -1;  // of the replicates
  int32_t step = 0;
  int64_t steps_without_loss = 0;
  bool weighed = false;
  std::vector<double> weights;              // of the emitters, for AllocateRays
  std::unique_ptr<const SurfaceTree> tree;  // of method phs-hier
  SightingTable sightings;                  // of all passes: what was seen stays true
};

absl::Status Solver::State::Weigh() {
  if (weighed) return absl::OkStatus();
  absl::StatusOr<std::vector<double>> made = AllocationWeights(*patches, options.shoot);
  if (!made.ok()) return made.status();
  weights = *std::move(made);
  weighed = true;
  return absl::OkStatus();
}

Progress Solver::State::CurrentProgress() const {
  Progress progress;
  progress.pass = at.next_pass;
  progress.step = at.last_step;
  progress.rays = at.rays;
  progress.seconds = Seconds();
  progress.cpu_seconds = at.cpu_seconds;
  progress.unsent_fraction = at.unsent_fraction;
  progress.estimated_rms_area = estimated_rms_area;
  progress.estimated_rms_patch = estimated_rms_patch;
  progress.wanted_rms_area = options.max_error;
  progress.max_rays = options.max_rays;
  return progress;
}

absl::Status Solver::State::CheckAbsorption(const StepPlan& plan, const UnitResult& result,
                                            const FluxLedger& ledger) {
  double shot = 0;
  for (int c = 0; c < 3; ++c) shot += static_cast<double>(result.shot[c]) * plan.quantum_lm[c];
  const bool nothing_lost = ledger.unsent_total_lm() >= shot * (1 - 1e-13);
  steps_without_loss = nothing_lost && shot > 0 ? steps_without_loss + 1 : 0;
  if (steps_without_loss < kStepsWithoutLoss) return absl::OkStatus();
  return MakeError(absl::StatusCode::kFailedPrecondition,
                   {"SINGULAR_CLOSED_RHO_1", "scene",
                    "no flux is ever absorbed or escapes: closed, with a reflectance of 1",
                    "give some material a reflectance under 1"});
}

StepPlan Solver::State::PlanStep(double flux_per_ray, const FluxLedger& ledger) const {
  const RandomStream stream{options.seed, 0, static_cast<uint32_t>(step),
                            static_cast<uint32_t>(at.next_pass)};
  const double offset = RandomNumbers(stream, 0, RandomPurpose::kPatchOffset)[0];
  StepPlan plan = AllocateRays(ledger.unsent(), flux_per_ray, offset, weights);
  if (options.shoot.method == Method::kPhsAlpha) {
    for (Visit& visit : plan.visits) {
      visit.seen = sightings.Counts(visit.emitter, options.shoot.pyramids.CellCount(),
                                    options.shoot.pyramids.count_unseen);
    }
  }
  if (tree != nullptr) {
    plan.rays_per_m2 = static_cast<double>(plan.rays) / ShootingArea(*patches, step == 0);
  }
  return plan;
}

absl::StatusOr<bool> Solver::State::RunStep(StepExecutor& executor, double flux_per_ray,
                                            FluxLedger& ledger) {
  const bool whole = options.shoot.method == Method::kExact;  // a unit returns a solution
  const StepPlan plan = whole ? PlanWholePass(ledger.unsent(), *patches, at.pass_rays)
                              : PlanStep(flux_per_ray, ledger);
  const int64_t unit_rays = whole ? plan.rays : UnitRays(plan.rays, patches->size());
  UnitResult result;
  if (plan.rays > 0) {
    absl::StatusOr<UnitResult> ran =
        executor.RunStep(CutIntoUnits(plan, options.seed, static_cast<uint32_t>(at.next_pass),
                                      static_cast<uint32_t>(step), unit_rays));
    if (!ran.ok()) return ran.status();
    result = *std::move(ran);
  }
  whole ? ledger.BookSolution(plan, result) : ledger.Book(plan, result);
  sightings.Add(result.sightings);
  at.rays += result.rays;
  at.cpu_seconds += result.cpu_seconds;
  at.last_step = step++;
  const double unsent = ledger.unsent_total_lm();
  at.unsent_fraction = unsent / ledger.emitted_total_lm();
  if (absl::Status status = CheckAbsorption(plan, result, ledger); !status.ok()) return status;
  return unsent > options.unsent_tolerance * ledger.emitted_total_lm();
}

absl::Status Solver::State::RunOnePass(StepExecutor& executor,
                                       const std::function<void(const Progress&)>& on_step) {
  if (absl::Status status = Weigh(); !status.ok()) return status;
  FluxLedger ledger(*patches, tree.get());
  const double first_rays =
      std::max(1.0, static_cast<double>(at.pass_rays) / at.rays_per_first_ray);
  const double flux_per_ray = ledger.emitted_total_lm() / first_rays;
  const int64_t rays_before = at.rays;
  int64_t first_step_rays = 0;
  step = 0;
  steps_without_loss = 0;
  bool more = true;
  while (more) {
    absl::StatusOr<bool> stepped = RunStep(executor, flux_per_ray, ledger);
    const int64_t pass_rays = at.rays - rays_before;
    if (!stepped.ok()) {
      // Cancelled: a first pass that was begun is better than nothing.
      if (replicates.passes() == 0 && pass_rays > 0) replicates.Add(ledger, pass_rays);
      return stepped.status();
    }
    more = *stepped;
    if (step == 1) first_step_rays = pass_rays;
    if (on_step) on_step(CurrentProgress());
    if (more && TimeIsOut()) {
      at.stop = StopReason::kTimeSpent;
      if (replicates.passes() == 0 && pass_rays > 0) replicates.Add(ledger, pass_rays);
      return absl::OkStatus();
    }
    if (more && step >= options.max_steps) {
      return MakeError(absl::StatusCode::kResourceExhausted,
                       {"STEPS_EXHAUSTED", "pass " + std::to_string(at.next_pass),
                        "flux is still unsent after " + std::to_string(step) + " steps",
                        "lower the reflectances or raise the tolerance of unsent flux"});
    }
  }
  KeepPass(ledger, at.rays - rays_before, first_step_rays);
  return absl::OkStatus();
}

void Solver::State::KeepPass(const FluxLedger& ledger, int64_t pass_rays, int64_t first_step_rays) {
  if (pass_rays > 0) replicates.Add(ledger, pass_rays);
  if (first_step_rays > 0) {
    at.rays_per_first_ray = static_cast<double>(pass_rays) / static_cast<double>(first_step_rays);
  }
  ++at.next_pass;
  EstimateError();
  DecideNext();
}

void Solver::State::EstimateError() {
  estimated_rms_area = replicates.EstimatedRmsArea();
  estimated_rms_patch = replicates.EstimatedRmsPatch();
}

void Solver::State::DecideNext() {
  const double estimated = estimated_rms_area;
  const bool believable = replicates.passes() >= kMinPassesForError && estimated >= 0;
  if (options.max_error > 0 && believable && estimated <= options.max_error) {
    at.stop = StopReason::kErrorReached;
    return;
  }
  if (TimeIsOut()) {
    at.stop = StopReason::kTimeSpent;
    return;
  }
  double next = static_cast<double>(at.pass_rays);
  // mcr repeats itself; the others grow.
  if (at.next_pass >= kFirstPasses && options.shoot.method != Method::kMcr) next *= kPassGrowth;
  if (options.max_error > 0 && believable) {
    // Error falls like one over the root of the rays: do not shoot far past what is wanted.
    const double ratio = estimated / options.max_error;
    const double missing = static_cast<double>(at.rays) * (ratio * ratio - 1) * 1.1;
    next = std::min(next, std::max(missing, static_cast<double>(at.rays) * 0.1));
  }
  if (options.max_rays > 0) {
    const double left = static_cast<double>(options.max_rays - at.rays);
    if (left < 2 * kBudgetMargin * static_cast<double>(options.max_rays)) {
      at.stop = StopReason::kRaysSpent;
      return;
    }
    const double usable = left * (1 - kBudgetMargin);
    if (usable < 1.5 * next) next = usable;
  }
  if (options.max_time_s > 0 && at.rays > 0) {
    const double left = options.max_time_s - Seconds();
    const double fits = static_cast<double>(at.rays) / std::max(Seconds(), 1e-6) * left * 0.95;
    if (fits < 0.05 * next) {
      at.stop = StopReason::kTimeSpent;
      return;
    }
    next = std::min(next, fits);
  }
  at.pass_rays = std::max<int64_t>(1, std::llround(next));
}

Solver::Solver(std::shared_ptr<const PatchSet> patches, const SolveOptions& options,
               std::function<double()> seconds_now)
    : state_(std::make_unique<State>(std::move(patches), options, std::move(seconds_now))) {}
Solver::~Solver() = default;

StopReason Solver::stop_reason() const { return state_->at.stop; }

bool Solver::reached_goal() const {
  return state_->at.stop == StopReason::kErrorReached ||
         state_->at.stop == StopReason::kNothingToShoot || state_->options.max_error == 0;
}

absl::Status Solver::RunPass(StepExecutor& executor,
                             const std::function<void(const Progress&)>& on_step) {
  const int32_t until = std::max(state_->at.next_pass + 1, kFirstPasses);
  while (state_->at.stop == StopReason::kNone && state_->at.next_pass < until) {
    absl::Status status = state_->RunOnePass(executor, on_step);
    if (!status.ok()) return status;
  }
  ++state_->at.version;
  return absl::OkStatus();
}

Snapshot Solver::MakeSnapshot() const {
  Snapshot snapshot;
  snapshot.version = state_->at.version;
  snapshot.progress = state_->CurrentProgress();
  snapshot.solution = std::make_shared<const Solution>(state_->replicates.Mean());
  return snapshot;
}

std::string Solver::EncodeCheckpoint() const {
  RunState at = state_->at;
  at.seconds = state_->Seconds();
  return lambert::EncodeCheckpoint(at, state_->replicates, state_->sightings);
}

absl::Status Solver::Restore(const std::string& checkpoint) {
  absl::Status status =
      RestoreCheckpoint(checkpoint, state_->at, state_->replicates, state_->sightings);
  if (!status.ok()) return status;
  state_->EstimateError();
  state_->started = state_->now();
  return absl::OkStatus();
}

}  // namespace lambert

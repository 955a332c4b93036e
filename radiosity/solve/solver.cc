#include "radiosity/solve/solver.h"

#include <algorithm>
#include <cmath>

#include "radiosity/patch/surface_tree.h"
#include "radiosity/shoot/importance.h"
#include "radiosity/shoot/light_groups.h"
#include "radiosity/solve/checkpoint.h"
#include "radiosity/solve/pass.h"
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
constexpr double kMostReflectance = 1 - 1e-7;

// Rays of a whole pass for each ray of its first step, before any pass has told: 1 / (1 - rho) with
// the area's mean reflectance, as in a closed scene.
double GuessRaysPerFirstRay(const PatchSet& patches) {
  CompensatedSum area, reflecting;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    area.Add(patches.area_m2[i]);
    reflecting.Add(patches.area_m2[i] * Mean(patches.reflectance[i]));
  }
  return 1 / (1 - std::min(reflecting.value() / area.value(), kMostReflectance));
}

}  // namespace

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
        replicates(*patches, options.shoot.method != Method::kExact),
        started(now()) {
    if (options.shoot.method == Method::kPhsHier) {
      tree = std::make_unique<const SurfaceTree>(*patches);
    }
    at.pass_rays = FirstPassRays(*patches, options);
    at.rays_per_first_ray = GuessRaysPerFirstRay(*patches);
    const Rgb emitted = EmittedFlux(*patches);
    if (!(ChannelSum(emitted) > 0)) {
      at.stop = StopReason::kNothingToShoot;
      at.unsent_fraction = 0;
    }
  }

  double Seconds() const { return at.seconds + now() - started; }
  Progress CurrentProgress() const;
  absl::Status RunOnePass(StepExecutor& executor,
                          const std::function<void(const Progress&)>& on_step);
  void KeepPass(const Pass& pass);
  bool KnowsError() const { return !options.shoot.parts.without.Has(Part::kStdError); }
  bool TimeIsOut() const { return options.max_time_s > 0 && Seconds() >= options.max_time_s; }
  // Fills `weights` and `light_groups`, once.
  absl::Status Prepare();
  // What the passes so far tell the next one, where it shoots ahead.
  Ambient::Before Before() const;
  void EstimateError();
  void DecideNext();

  const std::shared_ptr<const PatchSet> patches;
  const SolveOptions options;
  const std::function<double()> now;
  Replicates replicates;
  double started;
  RunState at;                                               // where the run stands
  double estimated_rms_area = -1, estimated_rms_patch = -1;  // of the replicates
  bool prepared = false;
  std::vector<double> weights;              // of the emitters, for AllocateRays
  std::vector<int32_t> light_groups;        // empty: nothing is shot ahead
  std::unique_ptr<const SurfaceTree> tree;  // of method phs-hier
  SightingTable sightings;                  // of all passes: what was seen stays true
};

absl::Status Solver::State::Prepare() {
  if (prepared) return absl::OkStatus();
  absl::StatusOr<std::vector<double>> made = AllocationWeights(*patches, options.shoot);
  if (!made.ok()) return made.status();
  weights = *std::move(made);
  if (options.shoot.parts.with.Has(Part::kAmbient)) {
    absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*patches);
    if (!scene.ok()) return scene.status();
    light_groups = FindLightGroups(*patches, **scene);
  }
  prepared = true;
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

absl::Status Solver::State::RunOnePass(StepExecutor& executor,
                                       const std::function<void(const Progress&)>& on_step) {
  if (absl::Status status = Prepare(); !status.ok()) return status;
  const Ambient::Before before = Before();
  Pass pass({*patches, options, weights, light_groups, before, tree.get(), sightings}, at.next_pass,
            at.pass_rays, at.rays_per_first_ray);
  const int64_t rays_before = at.rays;
  const double cpu_before = at.cpu_seconds;
  // A first pass that was begun is better than nothing.
  const auto stop_here = [&] {
    if (replicates.passes() == 0 && pass.rays() > 0) replicates.Add(pass.ledger(), at.pass_rays);
  };
  bool more = true;
  while (more) {
    const absl::StatusOr<bool> stepped = pass.Step(executor);
    at.rays = rays_before + pass.rays();
    at.cpu_seconds = cpu_before + pass.cpu_seconds();
    at.unsent_fraction = pass.unsent_fraction();
    at.last_step = pass.steps() - 1;
    if (!stepped.ok()) {
      stop_here();
      return stepped.status();
    }
    more = *stepped;
    if (on_step) on_step(CurrentProgress());
    if (more && TimeIsOut()) {
      at.stop = StopReason::kTimeSpent;
      stop_here();
      return absl::OkStatus();
    }
  }
  KeepPass(pass);
  return absl::OkStatus();
}

Ambient::Before Solver::State::Before() const {
  Ambient::Before before;
  if (light_groups.empty() || replicates.passes() == 0) return before;
  before.flux_lm = replicates.Mean().radiosity_lm_per_m2;
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    before.flux_lm[i] = before.flux_lm[i] * patches->area_m2[i];
  }
  before.rays = at.rays;
  return before;
}

void Solver::State::KeepPass(const Pass& pass) {
  // Weighted by the rays that were wanted: those that it took depend on what it found.
  if (pass.rays() > 0) replicates.Add(pass.ledger(), at.pass_rays);
  if (pass.rays_per_first_ray() > 0) at.rays_per_first_ray = pass.rays_per_first_ray();
  ++at.next_pass;
  EstimateError();
  DecideNext();
}

void Solver::State::EstimateError() {
  if (!KnowsError()) return;
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
  if (!KnowsError()) next = static_cast<double>(options.max_rays);  // the pilot is over
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
  Solution solution = state_->replicates.Mean();
  if (!state_->KnowsError()) {
    std::fill(solution.std_error_lm_per_m2.begin(), solution.std_error_lm_per_m2.end(),
              kUnknownError);
  }
  snapshot.solution = std::make_shared<const Solution>(std::move(solution));
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

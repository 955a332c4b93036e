// One pass: a solution from scratch with random numbers of its own.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/patch/surface_tree.h"
#include "radiosity/solve/ambient.h"
#include "radiosity/solve/flux_ledger.h"
#include "radiosity/solve/options.h"
#include "radiosity/solve/sightings.h"
#include "radiosity/solve/step_executor.h"

namespace lambert {

// What the passes of a run have in common. All must outlive them.
struct PassSetting {
  const PatchSet& patches;
  const SolveOptions& options;
  const std::vector<double>& weights;        // of the emitters, for AllocateRays
  const std::vector<int32_t>& light_groups;  // empty: nothing is shot ahead
  const Ambient::Before& before;             // of use with light groups only
  const SurfaceTree* tree;                   // of method phs-hier, else null
  SightingTable& sightings;                  // of all passes: what was seen stays true
};

class Pass {
 public:
  // Takes about `rays` rays, if a pass takes `rays_per_first_ray` times the rays of the emission.
  Pass(const PassSetting& setting, int32_t number, int64_t rays, double rays_per_first_ray);

  // One more step; false where it was the last. FAILED_PRECONDITION (SINGULAR_CLOSED_RHO_1) where
  // flux never ends; RESOURCE_EXHAUSTED (STEPS_EXHAUSTED); the executor's errors are passed on, and
  // leave the ledger balanced.
  absl::StatusOr<bool> Step(StepExecutor& executor);

  const FluxLedger& ledger() const { return ledger_; }
  int32_t steps() const { return steps_; }
  int64_t rays() const { return rays_; }
  double cpu_seconds() const { return cpu_seconds_; }
  // About the share of the solution's flux that is still to come.
  double unsent_fraction() const { return unsent_fraction_; }
  // Of this pass, for the next one's constructor; 0 where nothing was shot.
  double rays_per_first_ray() const;

 private:
  int Channels() const {
    return setting_.options.shoot.parts.without.Has(Part::kColor) ? kGrayChannels : kColorChannels;
  }
  StepPlan PlanStep(double flux_per_ray_lm, const std::vector<UnsentFlux>& unsent,
                    int quanta_bits = kMaxQuantaBits) const;
  absl::StatusOr<UnitResult> Execute(StepExecutor& executor, const StepPlan& plan,
                                     int64_t unit_rays);
  // Each is one step, false where the pass is over: that of a method that solves a pass in one
  // unit; that of random walks; that of any other; and the same with flux shot ahead.
  absl::StatusOr<bool> SolveWhole(StepExecutor& executor);
  absl::StatusOr<bool> Walk(StepExecutor& executor);
  absl::StatusOr<bool> Shoot(StepExecutor& executor);
  absl::StatusOr<bool> ShootAhead(StepExecutor& executor);
  // `group`: of Ambient.
  absl::Status ShootPart(StepExecutor& executor, int32_t group, double flux_per_ray_lm,
                         const std::vector<UnsentFlux>& sent, int sign);

  const PassSetting setting_;
  const int32_t number_;
  const int64_t wanted_rays_;
  const double expected_rays_per_first_ray_;
  FluxLedger ledger_;
  std::optional<Ambient> ambient_;        // while flux is shot ahead
  double emitting_m2_ = 0, area_m2_ = 0;  // of the patches; with a tree only
  double flux_per_ray_lm_;
  int32_t steps_ = 0;
  // Of the first step of all, or those that walks begin with.
  int64_t rays_ = 0, first_rays_ = 0;
  double cpu_seconds_ = 0, unsent_fraction_ = 1;
  double shot_lm_ = 0;  // in all, over the channels
  int64_t steps_without_loss_ = 0;
};

}  // namespace lambert

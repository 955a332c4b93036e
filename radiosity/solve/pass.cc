#include "radiosity/solve/pass.h"

#include <algorithm>
#include <cmath>

#include "radiosity/core/error.h"
#include "radiosity/core/philox.h"
#include "radiosity/solve/allocate.h"

namespace lambert {
namespace {

// Steps after which shooting ahead is given up: a few dozen do where it helps.
constexpr int32_t kMaxAmbientSteps = 400;
// Of the emission of a scene that has stiff parts: what a whole pass takes is not known before.
constexpr double kFirstRays = 1000;
// Rays of a step of walks: a fifth of a minute of one core, after which there is something to see.
constexpr int64_t kWalkStepRays = 100'000'000;
// Bits of all flux that walks begin with, however many bounces follow.
constexpr int kLeastWalkBits = 30;
// Steps without any absorption or escape after which the flux is taken to have no way out.
constexpr int64_t kStepsWithoutLoss = 10000;

absl::Status NothingIsLost() {
  return MakeError(absl::StatusCode::kFailedPrecondition,
                   {"SINGULAR_CLOSED_RHO_1", "scene",
                    "no flux is ever absorbed or escapes: closed, with a reflectance of 1",
                    "give some material a reflectance under 1"});
}

double Area(const PatchSet& patches, bool emitters_only) {
  CompensatedSum area_m2;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!emitters_only || patches.exitance_lm_per_m2[i] != Rgb{}) area_m2.Add(patches.area_m2[i]);
  }
  return std::max(area_m2.value(), 1e-300);  // point lights only
}

}  // namespace

Pass::Pass(const PassSetting& setting, int32_t number, int64_t rays, double rays_per_first_ray)
    : setting_(setting),
      number_(number),
      wanted_rays_(rays),
      expected_rays_per_first_ray_(rays_per_first_ray),
      ledger_(setting.patches, setting.tree) {
  if (setting.tree != nullptr) {
    emitting_m2_ = Area(setting.patches, true);
    area_m2_ = Area(setting.patches, false);
  }
  const double emitted = ledger_.emitted_total_lm();
  const double first_rays = static_cast<double>(rays) / rays_per_first_ray;
  if (setting.light_groups.empty()) {
    flux_per_ray_lm_ = emitted / std::max(1.0, first_rays);
  } else {
    flux_per_ray_lm_ = emitted / std::max(kFirstRays, first_rays);
    // Before the first pass it is a mere guess how many rays the emission will ask for.
    const double least = setting.before.flux_lm.empty() ? static_cast<double>(rays) : 0;
    ambient_.emplace(setting.patches, setting.light_groups, setting.before,
                     Ambient::RayFlux{emitted / first_rays, flux_per_ray_lm_, least});
  }
}

absl::StatusOr<bool> Pass::Step(StepExecutor& executor) {
  if (ambient_ && (steps_ >= kMaxAmbientSteps || !ambient_->Helps())) ambient_.reset();
  const Method method = setting_.options.shoot.method;
  const absl::StatusOr<bool> more = method == Method::kExact  ? SolveWhole(executor)
                                    : method == Method::kWalk ? Walk(executor)
                                    : ambient_                ? ShootAhead(executor)
                                                              : Shoot(executor);
  if (more.ok() && *more && steps_ >= setting_.options.max_steps) {
    return MakeError(absl::StatusCode::kResourceExhausted,
                     {"STEPS_EXHAUSTED", "pass " + std::to_string(number_),
                      "flux is still unsent after " + std::to_string(steps_) + " steps",
                      "lower the reflectances or raise the tolerance of unsent flux"});
  }
  return more;
}

double Pass::rays_per_first_ray() const {
  if (!setting_.light_groups.empty()) return shot_lm_ / ledger_.emitted_total_lm();
  return first_rays_ > 0 ? static_cast<double>(rays_) / static_cast<double>(first_rays_) : 0;
}

StepPlan Pass::PlanStep(double flux_per_ray_lm, const std::vector<UnsentFlux>& unsent,
                        int quanta_bits) const {
  const RandomStream stream{setting_.options.seed, 0, static_cast<uint32_t>(steps_),
                            static_cast<uint32_t>(number_)};
  const double offset = RandomNumbers(stream, 0, RandomPurpose::kPatchOffset)[0];
  StepPlan plan = AllocateRays(unsent, flux_per_ray_lm, offset, setting_.weights, quanta_bits);
  plan.channels = Channels();
  plan.walks = setting_.options.shoot.method == Method::kWalk;
  if (setting_.options.shoot.method == Method::kPhsAlpha) {
    for (Visit& visit : plan.visits) {
      visit.seen =
          setting_.sightings.Counts(visit.emitter, setting_.options.shoot.pyramids.CellCount(),
                                    setting_.options.shoot.pyramids.count_unseen);
    }
  }
  if (setting_.tree != nullptr) {
    // Rays start from the emitters at first, from all patches when light is everywhere.
    plan.rays_per_m2 = static_cast<double>(plan.rays) / (steps_ == 0 ? emitting_m2_ : area_m2_);
  }
  return plan;
}

absl::StatusOr<UnitResult> Pass::Execute(StepExecutor& executor, const StepPlan& plan,
                                         int64_t unit_rays) {
  UnitResult result;
  if (plan.rays > 0) {
    absl::StatusOr<UnitResult> ran =
        executor.RunStep(CutIntoUnits(plan, setting_.options.seed, static_cast<uint32_t>(number_),
                                      static_cast<uint32_t>(steps_), unit_rays));
    if (!ran.ok()) return ran.status();
    result = *std::move(ran);
    if (plan.channels == kGrayChannels) SpreadGray(result);
  }
  setting_.sightings.Add(result.sightings);
  rays_ += result.rays;
  for (int c = 0; c < 3; ++c) shot_lm_ += InLumen(result.shot, plan.quantum_lm)[c];
  cpu_seconds_ += result.cpu_seconds;
  if (steps_++ == 0 || plan.walks) first_rays_ += plan.rays;
  return result;
}

absl::StatusOr<bool> Pass::SolveWhole(StepExecutor& executor) {
  StepPlan plan = PlanWholePass(ledger_.unsent(), setting_.patches, wanted_rays_);
  plan.channels = Channels();
  const absl::StatusOr<UnitResult> result = Execute(executor, plan, plan.rays);
  if (!result.ok()) return result.status();
  ledger_.BookSolution(ledger_.unsent(), plan, *result);
  unsent_fraction_ = 0;
  return false;
}

absl::StatusOr<bool> Pass::Walk(StepExecutor& executor) {
  // All that arrives stays in the range of what one bounce may bring.
  const int bounces = std::max(0, std::ilogb(expected_rays_per_first_ray_) + 1);
  const int64_t steps_left = std::max<int64_t>(1, wanted_rays_ / kWalkStepRays - steps_);
  const std::vector<UnsentFlux> sent =
      Scaled(ledger_.unsent(), 1 / static_cast<double>(steps_left));
  const StepPlan plan =
      PlanStep(flux_per_ray_lm_, sent, std::max(kLeastWalkBits, kMaxQuantaBits - bounces));
  const double unit_rays = static_cast<double>(
      UnitRays(std::llround(static_cast<double>(plan.rays) * expected_rays_per_first_ray_),
               setting_.patches.size()));
  const absl::StatusOr<UnitResult> result = Execute(
      executor, plan, std::max<int64_t>(1, std::llround(unit_rays / expected_rays_per_first_ray_)));
  if (!result.ok()) return result.status();
  ledger_.BookSolution(sent, plan, *result);
  unsent_fraction_ = ledger_.unsent_total_lm() / ledger_.emitted_total_lm();
  return steps_left > 1;
}

absl::Status Pass::ShootPart(StepExecutor& executor, int32_t group, double flux_per_ray_lm,
                             const std::vector<UnsentFlux>& sent, int sign) {
  const StepPlan plan = PlanStep(flux_per_ray_lm, sent);
  const absl::StatusOr<UnitResult> result =
      Execute(executor, plan, UnitRays(plan.rays, setting_.patches.size()));
  if (!result.ok()) return result.status();
  std::vector<UnsentFlux> residual;
  if (ambient_) residual = Scaled(ambient_->Learn(group, sent, plan, *result), sign);
  ledger_.Book(sent, plan, *result, sign);
  if (!residual.empty()) ledger_.TakeBack(residual);
  return absl::OkStatus();
}

absl::StatusOr<bool> Pass::Shoot(StepExecutor& executor) {
  const Ledger before = ledger_.Balance();
  const auto shoot = [&](const std::vector<UnsentFlux>& sent, int sign) {
    return ShootPart(executor, kNoGroup, flux_per_ray_lm_, sent, sign);
  };
  absl::Status status =
      ledger_.owes() ? shoot(OfSign(ledger_.unsent(), 1), 1) : shoot(ledger_.unsent(), 1);
  if (status.ok() && ledger_.owes()) status = shoot(OfSign(ledger_.unsent(), -1), -1);
  if (!status.ok()) return status;
  const Ledger after = ledger_.Balance();
  const bool nothing_lost = after.absorbed == before.absorbed && after.escaped == before.escaped;
  steps_without_loss_ = nothing_lost ? steps_without_loss_ + 1 : 0;
  if (steps_without_loss_ >= kStepsWithoutLoss) return NothingIsLost();
  const double unsent = ledger_.unsent_total_lm();
  unsent_fraction_ = unsent / ledger_.emitted_total_lm();
  return unsent > setting_.options.unsent_tolerance * ledger_.emitted_total_lm();
}

absl::StatusOr<bool> Pass::ShootAhead(StepExecutor& executor) {
  const double elsewhere = setting_.options.unsent_tolerance * ledger_.emitted_total_lm();
  const std::vector<UnsentFlux> ahead = ambient_->Ahead(ledger_);
  // What remains at the end is small, but of a mean that only flux shot ahead makes up for.
  const bool settles = steps_ > 0 && ambient_->IsDone(ledger_, elsewhere);
  ledger_.Add(ahead);
  absl::Status status;
  for (int sign : {1, -1}) {
    for (const Ambient::Part& part :
         ambient_->Divide(OfSign(settles ? ahead : ledger_.unsent(), sign))) {
      if (!status.ok()) break;
      status = ShootPart(executor, part.group, part.flux_per_ray_lm, part.unsent, sign);
    }
  }
  ledger_.Add(Scaled(ahead, -1));
  if (!status.ok()) return status;
  if (ambient_->LosesNothing()) return NothingIsLost();
  unsent_fraction_ = ambient_->Left(ledger_);
  return !settles;
}

}  // namespace lambert

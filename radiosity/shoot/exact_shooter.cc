#include "radiosity/shoot/exact_shooter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/core/error.h"
#include "radiosity/exact/balance.h"
#include "radiosity/exact/exact_solver.h"
#include "radiosity/shoot/this_thread.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {
namespace {

using Flux = std::vector<double>;  // quanta of one channel

constexpr double kMostQuanta = 4.6e18;  // of all that is emitted, or arrives: under 2^62

absl::Status BadUnit(const std::string& what) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"FIELD_INVALID", "work unit", what, "send units of this patch set"});
}

Flux Channel(const std::vector<Rgb>& values, int channel) {
  Flux flux;
  for (const Rgb& value : values) flux.push_back(value[channel]);
  return flux;
}

void KeepFirstChannel(UnitResult& result) {
  for (Deposit& d : result.deposits) d.g = d.b = 0;
  result.shot = {result.shot[0], 0, 0};
  result.escaped = {result.escaped[0], 0, 0};
  result.channels = kGrayChannels;
}

class ExactShooter : public Shooter {
 public:
  ExactShooter(std::shared_ptr<const PatchSet> patches, std::unique_ptr<RayScene> scene,
               bool may_hide)
      : patches_(std::move(patches)),
        scene_(std::move(scene)),
        solver_(*patches_, *scene_, may_hide) {
    for (int c = 0; c < 3; ++c) reflectance_[c] = Channel(patches_->reflectance, c);
  }

  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override;

 private:
  // What the unit's emitters emit, by channel.
  absl::StatusOr<std::array<Flux, 3>> Emitted(const WorkUnit& unit) const;
  UnitResult Deposits(const std::array<Flux, 3>& arrived, const std::array<Flux, 3>& emitted) const;

  const std::shared_ptr<const PatchSet> patches_;
  const std::unique_ptr<RayScene> scene_;
  const ExactSolver solver_;
  std::array<Flux, 3> reflectance_;
};

absl::StatusOr<std::array<Flux, 3>> ExactShooter::Emitted(const WorkUnit& unit) const {
  if (unit.pass >= 1u << 16) return BadUnit("pass is 65536 or more");
  const size_t emitters = patches_->corners.size() + patches_->lights.size();
  std::array<Flux, 3> emitted;
  emitted.fill(Flux(emitters));
  Rgb total;
  for (const Visit& visit : unit.visits) {
    const bool is_whole = visit.ray_begin == 0 && visit.ray_end == visit.ray_count;
    if (visit.emitter < 0 || static_cast<size_t>(visit.emitter) >= emitters || !is_whole ||
        *std::min_element(visit.quanta.begin(), visit.quanta.end()) < 0) {
      return BadUnit("the visit of emitter " + std::to_string(visit.emitter) +
                     " is out of range or not whole");
    }
    for (int c = 0; c < 3; ++c) {
      const auto quanta = static_cast<double>(visit.quanta[c % unit.channels]);
      emitted[c][visit.emitter] += quanta;
      total[c] += quanta;
    }
  }
  if (!(std::max({total.r, total.g, total.b}) < kMostQuanta))
    return BadUnit("its quanta are too many");
  return emitted;
}

UnitResult ExactShooter::Deposits(const std::array<Flux, 3>& arrived,
                                  const std::array<Flux, 3>& emitted) const {
  UnitResult result;
  Quanta total{};
  for (int c = 0; c < 3; ++c) {
    for (double flux : emitted[c]) result.shot[c] += std::llround(flux);
  }
  for (PatchIndex i = 0; i < patches_->size(); ++i) {
    Quanta quanta;
    for (int c = 0; c < 3; ++c) {
      quanta[c] = std::llround(std::max(0.0, arrived[c][i]));
      total[c] += quanta[c];
      result.shot[c] += std::llround(reflectance_[c][i] * static_cast<double>(quanta[c]));
    }
    if (quanta != Quanta{}) result.deposits.push_back({quanta[0], quanta[1], quanta[2], 1, i});
  }
  for (int c = 0; c < 3; ++c) {
    // In a closed scene rounding can make more arrive than was shot.
    result.shot[c] = std::max(result.shot[c], total[c]);
    result.escaped[c] = result.shot[c] - total[c];
  }
  return result;
}

absl::StatusOr<UnitResult> ExactShooter::Run(const WorkUnit& unit) const {
  const DenormalsFlushed flushed;
  const double start = ThreadCpuSeconds();
  const absl::StatusOr<std::array<Flux, 3>> emitted = Emitted(unit);
  if (!emitted.ok()) return emitted.status();
  Flux all = (*emitted)[0];
  for (size_t i = 0; i < all.size(); ++i) all[i] += (*emitted)[1][i] + (*emitted)[2][i];
  const Transport transport = solver_.SampleTransport(all, unit.RayCount(), unit.seed, unit.pass);
  std::array<Flux, 3> arrived;
  for (int c = 0; c < 3; ++c) {
    // A channel like one before has its solution.
    int same = 0;
    while ((*emitted)[same] != (*emitted)[c] || reflectance_[same] != reflectance_[c]) ++same;
    if (same < c) {
      arrived[c] = arrived[same];
      continue;
    }
    absl::StatusOr<Flux> solved = solver_.Solve(transport, (*emitted)[c], reflectance_[c]);
    if (!solved.ok()) return solved.status();
    arrived[c] = *std::move(solved);
    double sum = 0;
    for (double flux : arrived[c]) sum += std::max(0.0, flux);
    if (!(sum < kMostQuanta)) return SingularBalance();
  }
  UnitResult result = Deposits(arrived, *emitted);
  if (unit.channels == kGrayChannels) KeepFirstChannel(result);
  result.rays = unit.RayCount();
  result.cpu_seconds = ThreadCpuSeconds() - start;
  return result;
}

}  // namespace

absl::StatusOr<std::shared_ptr<const Shooter>> CreateExactShooter(
    std::shared_ptr<const PatchSet> patches, const ShootOptions& options) {
  absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*patches);
  if (!scene.ok()) return scene.status();
  const DenormalsFlushed flushed;
  return std::shared_ptr<const Shooter>(std::make_shared<ExactShooter>(
      std::move(patches), *std::move(scene), !options.parts.without.Has(Part::kVisibility)));
}

}  // namespace lambert

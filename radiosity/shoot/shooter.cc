#include "radiosity/shoot/shooter.h"

#include <gnu/libc-version.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/pyramid/density.h"
#include "radiosity/shoot/arrivals.h"
#include "radiosity/shoot/directions.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/exact_shooter.h"
#include "radiosity/shoot/flight.h"
#include "radiosity/shoot/importance.h"
#include "radiosity/shoot/probe.h"
#include "radiosity/shoot/this_thread.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {
namespace {

// Changes whenever the same unit would give other bytes.
constexpr char kCodeVersion[] = "shoot-4";

class EmbreeShooter : public Shooter {
 public:
  EmbreeShooter(std::shared_ptr<const PatchSet> patches, const ShootOptions& options,
                std::unique_ptr<RayScene> scene)
      : patches_(std::move(patches)),
        options_(options),
        scene_(std::move(scene)),
        emitters_(*patches_, *scene_),
        arrivals_(patches_->size()) {}

  absl::Status Prepare();
  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override;

 private:
  // The rays of a visit that have directions in common: rays [first, first + count).
  struct Stage {
    uint32_t first = 0, count = 0;
    Quanta quanta{};  // that they share
  };

  absl::Status Check(const WorkUnit& unit) const;
  void ShootVisit(const Visit& visit, const RayNumbers& numbers, Flight& flight) const;
  void ShootDivided(const Visit& visit, const RayNumbers& numbers, Flight& flight) const;
  void ShootProbing(const Visit& visit, const RayNumbers& numbers, Flight& flight) const;
  void ShootStage(const Visit& visit, const Stage& stage, const Directions& directions,
                  const std::vector<uint32_t>& rays_of_cell, const RayNumbers& numbers,
                  Flight& flight) const;

  std::shared_ptr<const PatchSet> patches_;
  const ShootOptions options_;
  std::unique_ptr<RayScene> scene_;
  const Emitters emitters_;
  mutable ArrivalsPool arrivals_;
  std::unique_ptr<DirectionTable> directions_;
};

absl::Status EmbreeShooter::Prepare() {
  if (!UsesPyramids(options_.method)) return absl::OkStatus();
  absl::StatusOr<std::vector<double>> worth = HitWorth(*patches_, *scene_, emitters_, options_);
  if (!worth.ok()) return worth.status();
  directions_ =
      std::make_unique<DirectionTable>(*patches_, *scene_, emitters_, options_, *std::move(worth));
  return absl::OkStatus();
}

absl::Status EmbreeShooter::Check(const WorkUnit& unit) const {
  for (const Visit& v : unit.visits) {
    const bool in_range = v.emitter >= 0 && v.emitter < emitters_.size() &&
                          v.ray_begin <= v.ray_end && v.ray_end <= v.ray_count;
    const size_t cells = directions_ == nullptr ? 0 : directions_->sampler().fractions().size();
    const bool seen_fits = v.seen.empty() || v.seen.size() == cells;
    if (!in_range || !seen_fits || v.quanta[0] < 0 || v.quanta[1] < 0 || v.quanta[2] < 0) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"FIELD_INVALID", "work unit, emitter " + std::to_string(v.emitter),
                        "its rays or quanta are out of range", "send units of this patch set"});
    }
  }
  if (unit.pass >= 1u << 16) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "work unit", "pass is 65536 or more", "use fewer passes"});
  }
  return absl::OkStatus();
}

absl::StatusOr<UnitResult> EmbreeShooter::Run(const WorkUnit& unit) const {
  if (absl::Status status = Check(unit); !status.ok()) return status;
  const DenormalsFlushed flushed;
  const double start = ThreadCpuSeconds();
  UnitResult result;
  std::unique_ptr<Arrivals> arrivals = arrivals_.Borrow();
  const bool watch = options_.method == Method::kPhsAlpha;
  auto flight = std::make_unique<Flight>(*scene_, *arrivals, result, watch);
  for (const Visit& visit : unit.visits) {
    const RandomStream stream{unit.seed, static_cast<uint32_t>(visit.emitter), unit.step,
                              unit.pass};
    const RayNumbers numbers(stream, options_.sequence);
    const bool divided = directions_ != nullptr && !emitters_.IsPointLight(visit.emitter) &&
                         visit.ray_count >= directions_->min_rays();
    if (!divided) {
      ShootVisit(visit, numbers, *flight);
    } else if (options_.method == Method::kHs97) {
      ShootProbing(visit, numbers, *flight);
    } else {
      ShootDivided(visit, numbers, *flight);
    }
  }
  flight->Land();
  result.deposits = arrivals->Take();
  CombineSightings(result.sightings);
  arrivals_.Return(std::move(arrivals));
  result.cpu_seconds = ThreadCpuSeconds() - start;
  return result;
}

void EmbreeShooter::ShootVisit(const Visit& visit, const RayNumbers& numbers,
                               Flight& flight) const {
  if (visit.ray_begin == visit.ray_end) return;
  const bool point = emitters_.IsPointLight(visit.emitter);
  const EmitterFrame frame = point ? EmitterFrame{} : emitters_.Frame(visit.emitter);
  const Deal deal[3] = {{visit.quanta[0], visit.ray_count},
                        {visit.quanta[1], visit.ray_count},
                        {visit.quanta[2], visit.ray_count}};
  for (uint32_t ray = visit.ray_begin; ray < visit.ray_end;) {
    const uint32_t until = ray + std::min(flight.Room(), visit.ray_end - ray);
    const int slot = flight.batch().size;
    if (point) {
      AppendSphereRays(emitters_.Position(visit.emitter), numbers, ray, until, flight.batch());
    } else {
      AppendCosineRays(frame, numbers, ray, until, flight.batch());
    }
    for (int c = 0; c < 3; ++c) {
      for (uint32_t k = ray; k < until; ++k) {
        flight.SetFlux(slot + static_cast<int>(k - ray), c, deal[c].Of(k));
      }
    }
    ray = until;
  }
}

void EmbreeShooter::ShootDivided(const Visit& visit, const RayNumbers& numbers,
                                 Flight& flight) const {
  const std::shared_ptr<const Directions> directions =
      visit.seen.empty() ? directions_->Get(visit.emitter)
                         : std::make_shared<const Directions>(
                               directions_->FromWorth({visit.seen.begin(), visit.seen.end()}));
  const double offset = RandomNumbers(numbers.stream(), 0, RandomPurpose::kPyramidOffset)[0];
  ShootStage(visit, {0, visit.ray_count, visit.quanta}, *directions,
             CellRays(directions->densities, visit.ray_count, offset), numbers, flight);
}

// The first rays go by the cosine law and tell what is there; the others follow what they saw. Each
// kind carries the flux of its share of the rays, so both are unbiased whatever was seen.
void EmbreeShooter::ShootProbing(const Visit& visit, const RayNumbers& numbers,
                                 Flight& flight) const {
  const CellSampler& sampler = directions_->sampler();
  const auto offsets = RandomNumbers(numbers.stream(), 0, RandomPurpose::kPyramidOffset);
  const uint32_t probes =
      std::min<uint32_t>(visit.ray_count / 2,
                         static_cast<uint32_t>(options_.pyramids.probes * sampler.cells().size()));
  Stage first{0, probes, {}}, second{probes, visit.ray_count - probes, {}};
  for (int c = 0; c < 3; ++c) {
    const Deal deal(visit.quanta[c], visit.ray_count);
    first.quanta[c] = deal.quotient * probes + std::min<int64_t>(deal.remainder, probes);
    second.quanta[c] = visit.quanta[c] - first.quanta[c];
  }
  // Uniform densities are those of f_p: all cells that are worth nothing.
  const Directions by_flux = directions_->FromWorth(std::vector<double>(sampler.cells().size()));
  const std::vector<uint32_t> probing = CellRays(by_flux.densities, probes, offsets[0]);
  const std::vector<double> worth =
      ProbeWorth(sampler, *scene_, emitters_.Frame(visit.emitter), numbers, probing,
                 {options_.pyramids.rule, &directions_->hit_worth()}, nullptr);
  ShootStage(visit, first, by_flux, probing, numbers, flight);
  const Directions seen = directions_->FromWorth(worth);
  ShootStage(visit, second, seen, CellRays(seen.densities, second.count, offsets[1]), numbers,
             flight);
}

void EmbreeShooter::ShootStage(const Visit& visit, const Stage& stage, const Directions& directions,
                               const std::vector<uint32_t>& rays_of_cell, const RayNumbers& numbers,
                               Flight& flight) const {
  const CellSampler& sampler = directions_->sampler();
  const EmitterFrame frame = emitters_.Frame(visit.emitter);
  double sum = 0;
  for (float density : directions.densities) sum += density;
  uint32_t cell_begin = stage.first;  // first ray of the cell, within the visit
  // Slots of the batch that are filled with flux and cells but not yet with rays.
  uint32_t pending_from = std::max(stage.first, visit.ray_begin), pending = 0;
  int first_slot = flight.batch().size;
  const auto append = [&] {
    sampler.Append(frame, directions, flight.cell() + first_slot, numbers, pending_from,
                   pending_from + pending, flight.batch(), flight.weight());
    if (sampler.weighted()) flight.ApplyWeights(first_slot, first_slot + static_cast<int>(pending));
    pending_from += pending;
    pending = 0;
  };
  for (size_t p = 0; p < rays_of_cell.size(); ++p) {
    const uint32_t cell_end = cell_begin + rays_of_cell[p];
    const uint32_t from = std::max(cell_begin, visit.ray_begin);
    const uint32_t until = std::min(cell_end, visit.ray_end);
    if (from < until) {
      // A cell that expects less than one ray gets one with that probability, which then carries
      // the flux of all the times it gets none:  phi_ray = Phi_i f_p / r_ip.
      const double expected = directions.densities[p] / sum * stage.count;
      const double share = expected < 1 ? expected : rays_of_cell[p];
      const int64_t rays = std::max<int64_t>(1, std::llround(share));
      const double fraction = sampler.Fraction(directions, static_cast<int>(p));
      const auto deal = [&](int c) {
        return Deal(std::llround(static_cast<double>(stage.quanta[c]) * fraction *
                                 static_cast<double>(rays) / share),
                    rays);
      };
      const Deal deals[3] = {deal(0), deal(1), deal(2)};
      for (uint32_t ray = from; ray < until; ++ray) {
        if (flight.batch().size + static_cast<int>(pending) == RayBatch::kCapacity) {
          append();
          flight.Land();
        }
        if (pending == 0) first_slot = flight.batch().size;
        const int slot = first_slot + static_cast<int>(pending);
        flight.cell()[slot] = static_cast<int32_t>(p);
        flight.Watch(slot, visit.emitter);
        ++pending;
        for (int c = 0; c < 3; ++c) flight.SetFlux(slot, c, deals[c].Of(ray - cell_begin));
      }
    }
    cell_begin = cell_end;
  }
  if (pending > 0) append();
}

}  // namespace

std::string UnitVersion() {
  return std::string(kCodeVersion) + ";" + TracerPins() + ";glibc-" + gnu_get_libc_version();
}

absl::StatusOr<std::shared_ptr<const Shooter>> Shooter::Create(
    std::shared_ptr<const PatchSet> patches, const ShootOptions& options) {
  if (absl::Status status = ValidateFor(*patches, options); !status.ok()) return status;
  if (options.method == Method::kExact) return CreateExactShooter(std::move(patches));
  absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(*patches);
  if (!scene.ok()) return scene.status();
  auto shooter = std::make_shared<EmbreeShooter>(std::move(patches), options, *std::move(scene));
  if (absl::Status status = shooter->Prepare(); !status.ok()) return status;
  return std::shared_ptr<const Shooter>(std::move(shooter));
}

}  // namespace lambert

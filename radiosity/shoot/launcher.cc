#include "radiosity/shoot/launcher.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/pyramid/density.h"
#include "radiosity/shoot/importance.h"
#include "radiosity/shoot/probe.h"

namespace lambert {

absl::StatusOr<std::unique_ptr<Launcher>> Launcher::Create(const PatchSet& patches,
                                                           const ShootOptions& options,
                                                           const RayScene& scene) {
  std::unique_ptr<Launcher> launcher(new Launcher(patches, options, scene));
  if (!UsesPyramids(options.method)) return launcher;
  absl::StatusOr<std::vector<double>> worth =
      HitWorth(patches, scene, launcher->emitters_, options);
  if (!worth.ok()) return worth.status();
  launcher->directions_ = std::make_unique<DirectionTable>(patches, scene, launcher->emitters_,
                                                           options, *std::move(worth));
  return launcher;
}

// Cosine rays of patches, packed eight to a group whatever visits they are of: a group costs the
// same however few of its rays are used.
class Launcher::CosineRays {
 public:
  CosineRays(const Launcher& launcher, const WorkUnit& unit, Flight& flight)
      : emitters_(launcher.emitters_),
        sequence_(launcher.options_.sequence),
        stream_{unit.seed, 0, unit.step, unit.pass},
        flight_(flight) {}

  // The visit's last rays may wait for others: until Finish.
  void Shoot(const Visit& visit) {
    if (visit.ray_begin == visit.ray_end) return;
    const RayDeal deal(visit.quanta, visit.ray_count);
    uint32_t ray = visit.ray_begin;
    while (ray < visit.ray_end) {
      if (waiting_ == 0 && visit.ray_end - ray >= 8) {
        ray = ShootGroups(visit, deal, ray);
        continue;
      }
      const auto room = flight_.Room() - static_cast<uint32_t>(waiting_);
      const int slot = flight_.batch().size + waiting_;
      const uint32_t count =
          std::min({8 - static_cast<uint32_t>(waiting_), visit.ray_end - ray, room});
      flight_.SetFlux(slot, deal, ray, ray + count);
      for (uint32_t k = 0; k < count; ++k, ++waiting_) {
        names_.emitter[waiting_] = static_cast<uint32_t>(visit.emitter);
        names_.ray[waiting_] = ray + k;
      }
      ray += count;
      if (waiting_ == 8 || count == room) Finish();
    }
  }

  // Launches the rays that wait.
  void Finish() {
    if (waiting_ == 0) return;
    for (int lane = waiting_; lane < 8; ++lane) {
      names_.emitter[lane] = names_.emitter[0];
      names_.ray[lane] = names_.ray[0];
    }
    RandomNumbers8 numbers;
    FillRayNumbers(stream_, sequence_, names_, numbers);
    AppendCosineRays(emitters_.Frames(names_.emitter), numbers, waiting_, flight_.batch());
    waiting_ = 0;
  }

 private:
  // Whole groups of one visit from `ray` on. Returns the first ray after. Requires: none waits.
  uint32_t ShootGroups(const Visit& visit, const RayDeal& deal, uint32_t ray) {
    RandomStream stream = stream_;
    stream.emitter = static_cast<uint32_t>(visit.emitter);
    const RayNumbers numbers(stream, sequence_);
    const EmitterFrame frame = emitters_.Frame(visit.emitter);
    while (visit.ray_end - ray >= 8) {
      const uint32_t until = ray + std::min(flight_.Room(), (visit.ray_end - ray) & ~7u);
      const int slot = flight_.batch().size;
      AppendCosineRays(frame, numbers, ray, until, flight_.batch());
      flight_.SetFlux(slot, deal, ray, until);
      ray = until;
    }
    return ray;
  }

  const Emitters& emitters_;
  const Sequence sequence_;
  const RandomStream stream_;  // of the unit
  Flight& flight_;
  RayNames8 names_;  // of the rays that wait; their flux is in the slots after the batch's last ray
  int waiting_ = 0;
};

absl::Status Launcher::Launch(const WorkUnit& unit, Flight& flight) const {
  if (unit.pass >= 1u << 16) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "work unit", "pass is 65536 or more", "use fewer passes"});
  }
  CosineRays cosine_rays(*this, unit, flight);
  for (const Visit& visit : unit.visits) {
    if (!IsPossible(visit)) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"FIELD_INVALID", "work unit, emitter " + std::to_string(visit.emitter),
                        "its rays or quanta are out of range", "send units of this patch set"});
    }
    flight.Begin(visit);
    const bool point = emitters_.IsPointLight(visit.emitter);
    const bool divided =
        directions_ != nullptr && !point && visit.ray_count >= directions_->min_rays();
    if (!divided && !point) {
      cosine_rays.Shoot(visit);
      continue;
    }
    cosine_rays.Finish();
    const RandomStream stream{unit.seed, static_cast<uint32_t>(visit.emitter), unit.step,
                              unit.pass};
    const RayNumbers numbers(stream, options_.sequence);
    if (point) {
      ShootSphere(visit, numbers, flight);
    } else if (options_.method == Method::kHs97) {
      ShootProbing(visit, numbers, flight);
    } else {
      ShootDivided(visit, numbers, flight);
    }
  }
  cosine_rays.Finish();
  return absl::OkStatus();
}

void Launcher::ShootSphere(const Visit& visit, const RayNumbers& numbers, Flight& flight) const {
  for (uint32_t ray = visit.ray_begin; ray < visit.ray_end;) {
    const uint32_t until = ray + std::min(flight.Room(), visit.ray_end - ray);
    const int slot = flight.batch().size;
    AppendSphereRays(emitters_.Position(visit.emitter), numbers, ray, until, flight.batch());
    flight.SetFlux(slot, RayDeal(visit.quanta, visit.ray_count), ray, until);
    ray = until;
  }
}

void Launcher::ShootDivided(const Visit& visit, const RayNumbers& numbers, Flight& flight) const {
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
void Launcher::ShootProbing(const Visit& visit, const RayNumbers& numbers, Flight& flight) const {
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
      ProbeWorth(sampler, scene_, emitters_.Frame(visit.emitter), numbers, probing,
                 {options_.pyramids.rule, &directions_->hit_worth()});
  ShootStage(visit, first, by_flux, probing, numbers, flight);
  const Directions seen = directions_->FromWorth(worth);
  ShootStage(visit, second, seen, CellRays(seen.densities, second.count, offsets[1]), numbers,
             flight);
}

void Launcher::ShootStage(const Visit& visit, const Stage& stage, const Directions& directions,
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
      const int64_t rays = std::max<int64_t>(1, RoundedQuanta(share));
      const double fraction = sampler.Fraction(directions, static_cast<int>(p));
      const auto deal = [&](int c) {
        return Deal(RoundedQuanta(static_cast<double>(stage.quanta[c]) * fraction *
                                  static_cast<double>(rays) / share),
                    rays);
      };
      const RayDeal deals(deal(0), deal(1), deal(2));
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
        flight.SetFlux(slot, deals, ray - cell_begin);
      }
    }
    cell_begin = cell_end;
  }
  if (pending > 0) append();
}

}  // namespace lambert

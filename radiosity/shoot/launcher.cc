#include "radiosity/shoot/launcher.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/pyramid/density.h"
#include "radiosity/shoot/importance.h"
#include "radiosity/shoot/probe.h"

namespace lambert {
namespace {

// Whether what the visits shoot fits into its integers. Parts of one visit share its quanta.
bool HasRoom(const WorkUnit& unit) {
  Quanta left{kMaxUnitQuanta, kMaxUnitQuanta, kMaxUnitQuanta};
  PatchIndex emitter = -1;
  for (const Visit& visit : unit.visits) {
    const bool more_of_it = visit.emitter == emitter;
    emitter = visit.emitter;
    for (int c = 0; c < 3; ++c) {
      if (visit.quanta[c] < 0 || visit.quanta[c] > kMaxUnitQuanta) return false;
      if (more_of_it) continue;
      if (visit.quanta[c] > left[c]) return false;
      left[c] -= visit.quanta[c];
    }
  }
  return true;
}

// The quanta of a ray times its weights, rounded to the nearest.
Long4 Weighted(Long4 flux, const Rgb& weight) {
  for (int c = 0; c < 3; ++c) {
    flux[c] = RoundedQuanta(static_cast<double>(flux[c]) * weight[c]);
  }
  return flux;
}

}  // namespace

absl::StatusOr<std::unique_ptr<Launcher>> Launcher::Create(const PatchSet& patches,
                                                           const ShootOptions& options,
                                                           const RayScene& scene,
                                                           const SurfaceTree* tree) {
  std::unique_ptr<Launcher> launcher(new Launcher(patches, options, scene, tree));
  if (!UsesPyramids(options.method) || options.parts.without.Has(Part::kPyramids)) return launcher;
  absl::StatusOr<std::vector<double>> worth =
      HitWorth(patches, scene, launcher->emitters_, options);
  if (!worth.ok()) return worth.status();
  launcher->directions_ = std::make_unique<DirectionTable>(patches, scene, launcher->emitters_,
                                                           options, *std::move(worth), tree);
  return launcher;
}

// Where the systematic rounding of each visit starts, eight visits at once.
class Launcher::Offsets {
 public:
  explicit Offsets(const WorkUnit& unit) : unit_(unit) {}

  // Of the visit's only stage, or of its first (0) and second (1).
  uint32_t Of(size_t visit, int stage) {
    if (visit / 8 != block_) Fill(visit / 8);
    return bits_.bits[stage][visit % 8];
  }

 private:
  void Fill(size_t block) {
    block_ = block;
    RayNames8 names{};
    for (size_t k = 8 * block; k < std::min(8 * block + 8, unit_.visits.size()); ++k) {
      names.emitter[k % 8] = static_cast<uint32_t>(unit_.visits[k].emitter);
    }
    FillRandomBits({unit_.seed, 0, unit_.step, unit_.pass}, names, bits_,
                   RandomPurpose::kPyramidOffset);
  }

  const WorkUnit& unit_;
  size_t block_ = std::numeric_limits<size_t>::max();
  RandomBits8 bits_;
};

constexpr size_t kVisitsAhead = 16;  // tracing pushes them out of the cache: fetch them early

absl::Status Launcher::Launch(const WorkUnit& unit, Flight& flight) const {
  if (!HasRoom(unit)) {
    return MakeError(
        absl::StatusCode::kInvalidArgument,
        {"FIELD_INVALID", "work unit", "its quanta are negative or too many",
         "send units that hold at most " + std::to_string(kMaxUnitQuanta) + " quanta"});
  }
  if (unit.pass >= 1u << 16) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "work unit", "pass is 65536 or more", "use fewer passes"});
  }
  const RandomStream stream{unit.seed, 0, unit.step, unit.pass};
  Volley volley(emitters_, directions_ == nullptr ? nullptr : &directions_->sampler(), stream,
                options_.sequence, flight);
  Offsets offsets(unit);
  std::vector<CellHit> seen;
  if (options_.method == Method::kHs97) seen = ShootProbes(unit, offsets, volley, flight);
  absl::Span<const CellHit> unread(seen);
  for (size_t k = 0; k < unit.visits.size(); ++k) {
    const Visit& visit = unit.visits[k];
    __builtin_prefetch(&visit + kVisitsAhead);
    if (!IsPossible(visit)) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"FIELD_INVALID", "work unit, emitter " + std::to_string(visit.emitter),
                        "its rays are out of range", "send units of this patch set"});
    }
    flight.Begin(visit);
    const PatchIndex place = PlaceFor(unit, visit);
    if (emitters_.IsLight(visit.emitter)) {
      volley.Finish();
      ShootLight(visit, stream, flight);
    } else if (place == kNoPatch) {
      volley.ShootCosine(visit);
    } else if (options_.method == Method::kHs97) {
      const uint32_t probes = ProbingStage(visit).count;
      ShootFollowing(visit, unread.first(probes), offsets.Of(k, 1), volley);
      unread.remove_prefix(probes);
    } else {
      ShootDivided(visit, place, offsets.Of(k, 0), volley);
    }
  }
  volley.Finish();
  return absl::OkStatus();
}

void Launcher::ShootLight(const Visit& visit, RandomStream stream, Flight& flight) const {
  stream.emitter = static_cast<uint32_t>(visit.emitter);
  const RayNumbers numbers(stream, options_.sequence);
  const LightRays& light = emitters_.LightOf(visit.emitter);
  const auto weight = std::make_unique<Rgb[]>(RayBatch::kSlots);
  for (uint32_t ray = visit.ray_begin; ray < visit.ray_end;) {
    const uint32_t until = ray + std::min(flight.Room(), visit.ray_end - ray);
    const int slot = flight.batch().size;
    light.Append(numbers, ray, until, flight.batch(), weight.get());
    const RayDeal deal(visit.quanta, visit.ray_count);
    if (light.weighted()) {
      for (int k = slot; k < flight.batch().size; ++k) {
        const uint32_t shot = ray + (k - slot);
        flight.SetFlux(k, Weighted(deal.Of(shot), weight[k]), shot);
      }
    } else {
      flight.SetFlux(slot, deal, ray, until);
    }
    flight.LandIfFull();
    ray = until;
  }
}

void Launcher::ShootDivided(const Visit& visit, PatchIndex place, uint32_t offset,
                            Volley& volley) const {
  const Stage all{0, visit.ray_count, visit.quanta};
  if (visit.seen.empty()) {
    ShootStage(visit, all, *directions_->Get(place), offset, volley);
  } else {
    ShootStage(visit, all, directions_->FromWorth({visit.seen.begin(), visit.seen.end()}), offset,
               volley);
  }
}

// The first rays go by the cosine law and tell what is there; the others follow what they saw. Each
// kind carries the flux of its share of the rays, so both are unbiased whatever was seen.
Launcher::Stage Launcher::ProbingStage(const Visit& visit) const {
  const int cells = directions_->sampler().cells().size();
  Stage stage;
  stage.count =
      std::min(visit.ray_count / 2, static_cast<uint32_t>(options_.pyramids.probes * cells));
  for (int c = 0; c < 3; ++c) {
    const Deal deal(visit.quanta[c], visit.ray_count);
    stage.quanta[c] = deal.quotient * stage.count + std::min<int64_t>(deal.remainder, stage.count);
  }
  stage.probing = true;
  return stage;
}

// Returns what the probing rays of all divided visits hit, visit by visit.
std::vector<CellHit> Launcher::ShootProbes(const WorkUnit& unit, Offsets& offsets, Volley& volley,
                                           Flight& flight) const {
  std::vector<CellHit> hits;
  flight.RecordHits(&hits);
  for (size_t k = 0; k < unit.visits.size(); ++k) {
    const Visit& visit = unit.visits[k];
    if (!IsPossible(visit) || PlaceFor(unit, visit) == kNoPatch) continue;
    ShootStage(visit, ProbingStage(visit), directions_->by_flux(), offsets.Of(k, 0), volley);
  }
  volley.Finish();
  flight.Land();
  flight.RecordHits(nullptr);
  return hits;
}

void Launcher::ShootFollowing(const Visit& visit, absl::Span<const CellHit> seen, uint32_t offset,
                              Volley& volley) const {
  const Stage probing = ProbingStage(visit);
  Stage stage{probing.count, visit.ray_count - probing.count, visit.quanta};
  for (int c = 0; c < 3; ++c) stage.quanta[c] -= probing.quanta[c];
  if (seen.empty()) {
    ShootStage(visit, stage, directions_->by_flux(), offset, volley);
    return;
  }
  const std::vector<double> worth =
      WorthOfHits(seen, directions_->sampler().fractions(),
                  {options_.pyramids.rule, &directions_->hit_worth()});
  ShootStage(visit, stage, directions_->FromWorth(worth), offset, volley);
}

void Launcher::ShootStage(const Visit& visit, const Stage& stage, const Directions& directions,
                          uint32_t offset, Volley& volley) const {
  const uint32_t first = stage.probing ? 0 : visit.ray_begin;
  const uint32_t last = stage.probing ? visit.ray_count : visit.ray_end;
  const uint32_t until = std::min(last, stage.first + stage.count);
  const CellSampler& sampler = directions_->sampler();
  const Double4 quanta = {static_cast<double>(stage.quanta[0]),
                          static_cast<double>(stage.quanta[1]),
                          static_cast<double>(stage.quanta[2]), 0};
  VisitCells cells(directions.spans, stage.count, offset);
  for (uint32_t ray = std::max(first, stage.first); ray < until;) {
    const CellRays& rays = cells.Of(ray - stage.first);
    const SphericalTriangle* pyramid = sampler.Pyramid(directions, rays.cell);
    // phi_ray = Phi_i f_p / r_ip
    const double part = sampler.Fraction(directions, rays.cell) / rays.share;
    MeanDeal deal(quanta * part, ray - stage.first - rays.begin);
    const uint32_t cell_until = std::min(until, stage.first + rays.end);
    do {
      const bool carries = ray >= visit.ray_begin && ray < visit.ray_end;
      const Long4 flux = deal.Next();
      volley.ShootThrough(rays.cell, pyramid, visit.emitter, ray, carries ? flux : Long4{});
    } while (++ray < cell_until);
  }
}

}  // namespace lambert

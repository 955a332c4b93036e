// Rays on their way: gathered from any emitters, traced and deposited together.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "radiosity/core/lanes.h"
#include "radiosity/shoot/arrivals.h"
#include "radiosity/shoot/refinement.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/trace/ray_batch.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Quanta dealt over rays exactly: the quotient each, one extra to the first `remainder` rays.
struct Deal {
  int64_t quotient, remainder;
  Deal(int64_t quanta, int64_t rays)
      : quotient(rays == 1 ? quanta : quanta / rays), remainder(quanta - quotient * rays) {}
};

// Of the three channels at once, and the ray that carries them: r, g, b, 1.
struct RayDeal {
  Long4 quotient, remainder;
  RayDeal(const Deal& r, const Deal& g, const Deal& b)
      : quotient{r.quotient, g.quotient, b.quotient, 1},
        remainder{r.remainder, g.remainder, b.remainder, 0} {}
  // Deals `quanta` over `rays` rays.
  RayDeal(const Quanta& quanta, uint32_t rays)
      : RayDeal(Deal(quanta[0], rays), Deal(quanta[1], rays), Deal(quanta[2], rays)) {}
  Long4 Of(int64_t ray) const { return quotient - (remainder > ray); }
};

// Deals r, g, b quanta, which each ray carries on the average, over rays that follow each other:
// each takes what lies between the nearest whole numbers of all before it and of all with it. So
// rays lose nothing of what they share, up to 2^53 quanta; beyond, a double rounds. Requires: |sum|
// < 2^63.
class MeanDeal {
 public:
  // The first that asks comes after `before` others.
  MeanDeal(Double4 mean, uint32_t before)
      : mean_(mean), count_(before), dealt_(Nearest(mean * count_)) {}
  Long4 Next() {
    const Double4 until = Nearest(mean_ * ++count_), share = until - dealt_;
    dealt_ = until;
    const int64_t r = static_cast<int64_t>(share[0]), g = static_cast<int64_t>(share[1]),
                  b = static_cast<int64_t>(share[2]);
    return Long4{r, g, b, 1};
  }

 private:
  Double4 mean_;
  double count_;
  Double4 dealt_;
};

// The nearest whole number, halves away from zero, as std::llround has it. Requires: |x| < 2^63.
inline int64_t RoundedQuanta(double x) {
  constexpr double kBelowHalf = 0.5 - 0x1p-54;  // the sum rounds up where x ends in a half
  return static_cast<int64_t>(x + std::copysign(kBelowHalf, x));
}

// That a ray through a cell met a patch, or none (RayBatch::hit).
struct CellHit {
  int32_t cell = 0;
  PatchIndex hit = kEscaped;
};

// One thread at a time. What lands is added to `arrivals` and `result`, which must outlive it.
class Flight {
 public:
  // `watch`: what is seen is kept in the result's sightings (unordered until they are combined).
  Flight(const RayScene& scene, Arrivals& arrivals, UnitResult& result, bool watch)
      : scene_(scene), arrivals_(arrivals), result_(result), watch_(watch) {
    std::fill(std::begin(seer_), std::end(seer_), kNoPatch);
  }
  virtual ~Flight() = default;

  // What lands is added to `rests` as well, at the places that `refinement` says, for rays of a
  // unit (unit.h). Both must outlive the flight.
  void Refine(const Refinement& refinement, double unit_rays_per_m2, Arrivals& rests) {
    refinement_ = &refinement;
    unit_rays_per_m2_ = unit_rays_per_m2;
    rests_ = &rests;
  }
  // The rays that are given flux from now on are of `visit`, which must outlive them.
  void Begin(const Visit& visit) { visit_ = &visit; }

  RayBatch& batch() { return batch_; }
  float* weight() { return weight_; }  // by slot; room for a sampler
  // Rays that fit before the batch has to land; lands it when none fits.
  uint32_t Room();
  // What a slot's ray, of the visit that has begun, carries: r, g, b and itself, 1. A ray that
  // carries nothing, 0 of itself, only looks: it is not counted and what it hits is not hit.
  void SetFlux(int slot, Long4 flux, uint32_t ray) {
    flux_[slot] = flux;
    visit_of_[slot] = visit_;
    ray_of_[slot] = ray;
  }
  // Deals flux to rays [begin, end) from `slot` on.
  void SetFlux(int slot, const RayDeal& deal, uint32_t begin, uint32_t end) {
    for (uint32_t ray = begin; ray < end; ++ray) SetFlux(slot++, deal.Of(ray), ray);
  }
  // Says whose ray is in a slot, and through which cell it goes.
  void SetSeer(int slot, PatchIndex emitter, int32_t cell) {
    seer_[slot] = emitter;
    cell_[slot] = cell;
  }
  // What rays through cells hit is appended to `hits`, ray by ray, from the next landing on; null:
  // no longer.
  void RecordHits(std::vector<CellHit>* hits) { hits_ = hits; }
  // Multiplies the flux of slots begin .. end by their weights, rounded to the nearest quantum.
  void ApplyWeights(int begin, int end);
  void LandIfFull() {
    if (batch_.size == RayBatch::kCapacity) Land();
  }
  // Traces, deposits and empties the batch.
  virtual void Land();
  // OK, or why rays came to no end: what has landed is of no use then.
  const absl::Status& status() const { return status_; }

 protected:
  void Fail(absl::Status status) { status_ = std::move(status); }
  bool RecordsHits() const { return hits_ != nullptr; }
  void Trace() { scene_.Trace(batch_); }
  Long4 FluxOf(int slot) const { return flux_[slot]; }
  // Requires: the slot's ray is of a visit.
  const Visit& VisitOf(int slot) const { return *visit_of_[slot]; }
  uint32_t RayOf(int slot) const { return ray_of_[slot]; }
  // Land for rays that are traced; the batch's hits stay until it has rays again. Requires: every
  // ray of the batch has its hit.
  void LandTraced();

 private:
  // Where the rays come to rest.
  void Rest();
  void Tell();

  const RayScene& scene_;
  Arrivals& arrivals_;
  UnitResult& result_;
  const bool watch_;
  const Refinement* refinement_ = nullptr;
  double unit_rays_per_m2_ = 0;
  Arrivals* rests_ = nullptr;  // null: rays rest where they arrive
  absl::Status status_;
  const Visit* visit_ = nullptr;
  std::vector<CellHit>* hits_ = nullptr;
  RayBatch batch_;
  alignas(64) float weight_[RayBatch::kSlots];
  int32_t cell_[RayBatch::kSlots];
  PatchIndex seer_[RayBatch::kSlots];  // emitter of a ray through a cell, or kNoPatch
  const Visit* visit_of_[RayBatch::kSlots];
  uint32_t ray_of_[RayBatch::kSlots];
  alignas(64) Long4 flux_[RayBatch::kSlots];  // r, g, b, 1
};

}  // namespace lambert

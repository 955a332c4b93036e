// Rays on their way: gathered from any emitters, traced and deposited together.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

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

// The nearest whole number, halves away from zero, as std::llround has it. Requires: |x| < 2^63.
inline int64_t RoundedQuanta(double x) {
  constexpr double kBelowHalf = 0.5 - 0x1p-54;  // the sum rounds up where x ends in a half
  return static_cast<int64_t>(x + std::copysign(kBelowHalf, x));
}

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
  int32_t* cell() { return cell_; }    // by slot; room for a sampler
  // Rays that fit before the batch has to land; lands it when none fits.
  uint32_t Room();
  void SetFlux(int slot, const RayDeal& deal, int64_t ray) {
    flux_[slot] = deal.Of(ray);
    if (rests_ != nullptr) visit_of_[slot] = visit_;
  }
  // Deals flux to rays [begin, end) from `slot` on.
  void SetFlux(int slot, const RayDeal& deal, uint32_t begin, uint32_t end) {
    for (uint32_t ray = begin; ray < end; ++ray) SetFlux(slot++, deal, ray);
  }
  // Says whose ray is in a slot, and that what it hits through cell()[slot] is to be told.
  void Watch(int slot, PatchIndex emitter) { seer_[slot] = emitter; }
  // Multiplies the flux of slots begin .. end by their weights, rounded to the nearest quantum.
  void ApplyWeights(int begin, int end);
  // Traces, deposits and empties the batch.
  virtual void Land();

 protected:
  // Land for rays that are traced. Requires: every ray of the batch has its hit.
  void LandTraced();

 private:
  // Where the rays come to rest.
  void Rest();

  const RayScene& scene_;
  Arrivals& arrivals_;
  UnitResult& result_;
  const bool watch_;
  const Refinement* refinement_ = nullptr;
  double unit_rays_per_m2_ = 0;
  Arrivals* rests_ = nullptr;  // null: rays rest where they arrive
  const Visit* visit_ = nullptr;
  RayBatch batch_;
  alignas(64) float weight_[RayBatch::kSlots];
  int32_t cell_[RayBatch::kSlots];
  PatchIndex seer_[RayBatch::kSlots];         // emitter of a ray that is watched, or kNoPatch
  const Visit* visit_of_[RayBatch::kSlots];   // where rays come to rest elsewhere
  alignas(64) Long4 flux_[RayBatch::kSlots];  // r, g, b, 1
};

}  // namespace lambert

// Rays on their way: gathered from any emitters, traced and deposited together.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "radiosity/shoot/arrivals.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/trace/ray_batch.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Quanta dealt over rays exactly: the quotient each, one extra to the first `remainder` rays.
struct Deal {
  int64_t quotient, remainder;
  Deal(int64_t quanta, int64_t rays) : quotient(quanta / rays), remainder(quanta % rays) {}
  int64_t Of(int64_t ray) const { return quotient + (ray < remainder ? 1 : 0); }
};

// One thread at a time. What lands is added to `arrivals` and `result`, which must outlive it.
class Flight {
 public:
  // `watch`: what is seen is kept in the result's sightings (unordered until they are combined).
  Flight(const RayScene& scene, Arrivals& arrivals, UnitResult& result, bool watch)
      : scene_(scene), arrivals_(arrivals), result_(result), watch_(watch) {
    std::fill(std::begin(seer_), std::end(seer_), kNoPatch);
  }

  RayBatch& batch() { return batch_; }
  float* weight() { return weight_; }  // by slot; room for a sampler
  int32_t* cell() { return cell_; }    // by slot; room for a sampler
  // Rays that fit before the batch has to land; lands it when none fits.
  uint32_t Room();
  void SetFlux(int slot, int channel, int64_t quanta) { flux_[channel][slot] = quanta; }
  // Says whose ray is in a slot, and that what it hits through cell()[slot] is to be told.
  void Watch(int slot, PatchIndex emitter) { seer_[slot] = emitter; }
  // Multiplies the flux of slots begin .. end by their weights, rounded to the nearest quantum.
  void ApplyWeights(int begin, int end);
  // Traces, deposits and empties the batch.
  void Land();

 private:
  void Arrive(PatchIndex hit, int64_t r, int64_t g, int64_t b);

  const RayScene& scene_;
  Arrivals& arrivals_;
  UnitResult& result_;
  const bool watch_;
  RayBatch batch_;
  alignas(64) float weight_[RayBatch::kSlots];
  int32_t cell_[RayBatch::kSlots];
  PatchIndex seer_[RayBatch::kSlots];  // emitter of a ray that is watched, or kNoPatch
  alignas(64) int64_t flux_[3][RayBatch::kSlots];
};

}  // namespace lambert

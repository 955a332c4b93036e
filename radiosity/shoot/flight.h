// Rays on their way: gathered from any emitters, traced and deposited together.
#pragma once

#include <cstdint>

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
  Flight(const RayScene& scene, Arrivals& arrivals, UnitResult& result)
      : scene_(scene), arrivals_(arrivals), result_(result) {}

  RayBatch& batch() { return batch_; }
  float* weight() { return weight_; }  // by slot; room for a sampler
  int32_t* cell() { return cell_; }    // room for a sampler
  // Rays that fit before the batch has to land; lands it when none fits.
  uint32_t Room();
  void SetFlux(int slot, int channel, int64_t quanta) { flux_[channel][slot] = quanta; }
  // Multiplies the flux of slots begin .. end by their weights, rounded to the nearest quantum.
  void ApplyWeights(int begin, int end);
  // Traces, deposits and empties the batch.
  void Land();

 private:
  void Arrive(PatchIndex hit, int64_t r, int64_t g, int64_t b);

  const RayScene& scene_;
  Arrivals& arrivals_;
  UnitResult& result_;
  RayBatch batch_;
  alignas(64) float weight_[RayBatch::kSlots];
  int32_t cell_[RayBatch::kSlots];
  alignas(64) int64_t flux_[3][RayBatch::kSlots];
};

}  // namespace lambert

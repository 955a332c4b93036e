#include "radiosity/shoot/volley.h"

#include <algorithm>
#include <cstring>

namespace lambert {

void Volley::ShootCosine(const Visit& visit) {
  if (visit.ray_begin == visit.ray_end) return;
  SetKind(/*cosine=*/true);
  const RayDeal deal(visit.quanta, visit.ray_count);
  for (uint32_t ray = visit.ray_begin; ray < visit.ray_end;) {
    if (waiting_ == 0 && visit.ray_end - ray >= 8) {
      ray = ShootGroups(visit, deal, ray);
    } else {
      Wait(visit.emitter, ray, deal.Of(ray));
      ++ray;
    }
  }
}

// Whole groups of one visit from `ray` on. Returns the first ray after. Requires: none waits.
uint32_t Volley::ShootGroups(const Visit& visit, const RayDeal& deal, uint32_t ray) {
  RandomStream stream = stream_;
  stream.emitter = static_cast<uint32_t>(visit.emitter);
  const RayNumbers numbers(stream, sequence_);
  const EmitterFrame& frame = emitters_.Frame(visit.emitter);
  while (visit.ray_end - ray >= 8) {
    const uint32_t until = ray + std::min(flight_.Room(), (visit.ray_end - ray) & ~7u);
    const int slot = flight_.batch().size;
    AppendCosineRays(frame, numbers, ray, until, flight_.batch());
    flight_.SetFlux(slot, deal, ray, until);
    flight_.LandIfFull();
    ray = until;
  }
  return ray;
}

void Volley::Make(CellRays8& rays, int count) {
  RayBatch& batch = flight_.batch();
  for (int lane = count; lane < 8; ++lane) {
    rays.names.emitter[lane] = rays.names.emitter[0];
    rays.names.ray[lane] = rays.names.ray[0];
    rays.cells[lane] = rays.cells[0];
    rays.pyramids[lane] = rays.pyramids[0];
  }
  RandomNumbers8 numbers;
  FillRayNumbers(stream_, sequence_, rays.names, numbers);
  // Many rays of one visit follow each other.
  if (std::memcmp(framed_, rays.names.emitter, sizeof(framed_)) != 0) {
    std::memcpy(framed_, rays.names.emitter, sizeof(framed_));
    frames_ = emitters_.Frames(framed_);
  }
  if (cosine_) {
    AppendCosineRays(frames_, numbers, count, batch);
    return;
  }
  const int first = batch.size;
  sampler_->Append(frames_, rays, numbers, stream_, count, batch, flight_.weight());
  if (sampler_->weighted()) flight_.ApplyWeights(first, batch.size);
}

void Volley::Finish() {
  for (int first = 0; first < waiting_; first += 8) {
    Make(groups_[first / 8], std::min(8, waiting_ - first));
  }
  waiting_ = 0;
  flight_.LandIfFull();
}

}  // namespace lambert

#include "radiosity/shoot/flight.h"

#include <algorithm>

namespace lambert {

uint32_t Flight::Room() {
  LandIfFull();
  return static_cast<uint32_t>(RayBatch::kCapacity - batch_.size);
}

void Flight::ApplyWeights(int begin, int end) {
  for (int slot = begin; slot < end; ++slot) {
    for (int c = 0; c < 3; ++c) {
      flux_[slot][c] = RoundedQuanta(static_cast<double>(flux_[slot][c]) * weight_[slot]);
    }
  }
}

void Flight::Land() {
  scene_.Trace(batch_);
  LandTraced();
}

void Flight::Rest() {
  constexpr int kAhead = 16;
  PatchIndex place[RayBatch::kCapacity];
  for (int k = 0; k < batch_.size; ++k) {
    const int next = std::min(k + kAhead, batch_.size - 1);
    if (batch_.hit[next] >= 0) refinement_->Prefetch(batch_.hit[next]);
    place[k] = batch_.hit[k];
    if (place[k] < 0) continue;
    place[k] = refinement_->Place(*visit_of_[k], unit_rays_per_m2_, batch_, k);
    rests_->Prefetch(place[k]);
  }
  for (int k = 0; k < batch_.size; ++k) {
    if (place[k] >= 0) rests_->Add(place[k], flux_[k]);
  }
}

void Flight::LandTraced() {
  constexpr int kAhead = 32;  // deposits are random accesses: fetch them early
  Long4 shot{}, escaped{};
  for (int k = 0; k < batch_.size; ++k) {
    const int next = std::min(k + kAhead, batch_.size - 1);
    if (batch_.hit[next] >= 0 && flux_[next][3] != 0) arrivals_.Prefetch(batch_.hit[next]);
    if (flux_[k][3] == 0) continue;
    shot += flux_[k];
    if (batch_.hit[k] >= 0) {
      arrivals_.Add(batch_.hit[k], flux_[k]);
    } else {
      escaped += flux_[k];
    }
  }
  for (int c = 0; c < 3; ++c) {
    result_.shot[c] += shot[c];
    result_.escaped[c] += escaped[c];
  }
  result_.rays += shot[3];
  if (watch_) Tell();
  for (int k = 0; RecordsHits() && k < batch_.size; ++k) {
    hits_->push_back({cell_[k], batch_.hit[k]});
  }
  if (rests_ != nullptr) Rest();
  batch_.size = 0;
}

void Flight::Tell() {
  for (int k = 0; k < batch_.size; ++k) {
    if (seer_[k] >= 0 && batch_.hit[k] >= 0) {
      result_.sightings.push_back({seer_[k], cell_[k], batch_.hit[k], 1});
    }
    seer_[k] = kNoPatch;
  }
}

}  // namespace lambert

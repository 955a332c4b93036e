#include "radiosity/shoot/flight.h"

#include <algorithm>
#include <cmath>

namespace lambert {

uint32_t Flight::Room() {
  if (batch_.size == RayBatch::kCapacity) Land();
  return static_cast<uint32_t>(RayBatch::kCapacity - batch_.size);
}

void Flight::ApplyWeights(int begin, int end) {
  for (int c = 0; c < 3; ++c) {
    for (int slot = begin; slot < end; ++slot) {
      flux_[c][slot] = std::llround(static_cast<double>(flux_[c][slot]) * weight_[slot]);
    }
  }
}

void Flight::Land() {
  scene_.Trace(batch_);
  constexpr int kAhead = 16;  // deposits are random accesses: fetch them early
  for (int k = 0; k < batch_.size; ++k) {
    const PatchIndex next = batch_.hit[std::min(k + kAhead, batch_.size - 1)];
    if (next >= 0) arrivals_.Prefetch(next);
    Arrive(batch_.hit[k], flux_[0][k], flux_[1][k], flux_[2][k]);
  }
  for (int k = 0; watch_ && k < batch_.size; ++k) {
    if (seer_[k] >= 0 && batch_.hit[k] >= 0) {
      result_.sightings.push_back({seer_[k], cell_[k], batch_.hit[k], 1});
    }
    seer_[k] = kNoPatch;
  }
  result_.rays += batch_.size;
  batch_.size = 0;
}

void Flight::Arrive(PatchIndex hit, int64_t r, int64_t g, int64_t b) {
  result_.shot[0] += r;
  result_.shot[1] += g;
  result_.shot[2] += b;
  if (hit >= 0) {
    arrivals_.Add(hit, r, g, b);
    return;
  }
  result_.escaped[0] += r;
  result_.escaped[1] += g;
  result_.escaped[2] += b;
}

}  // namespace lambert

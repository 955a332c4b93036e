// Where the rays of a unit arrive: dense while they do, a list of the patches that were hit after.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/unit.h"

namespace lambert {

// One thread at a time.
class Arrivals {
 public:
  explicit Arrivals(PatchIndex patch_count) : cells_(patch_count) {}

  // Requires: 0 <= patch < patch_count.
  void Prefetch(PatchIndex patch) const { __builtin_prefetch(&cells_[patch], 1); }
  void Add(PatchIndex patch, int64_t r, int64_t g, int64_t b) {
    Cell& cell = cells_[patch];
    cell.r += r;
    cell.g += g;
    cell.b += b;
    if (cell.hits++ == 0) hit_.push_back(patch);
  }

  // What arrived, in the order of patches; nothing has arrived after.
  std::vector<Deposit> Take();

 private:
  struct alignas(32) Cell {  // an arrival touches one cache line
    int64_t r = 0, g = 0, b = 0, hits = 0;
  };
  std::vector<Cell> cells_;
  std::vector<PatchIndex> hit_;
};

// Keeps Arrivals for reuse: filling megabytes with zeros for a unit of few rays would take longer
// than tracing them. Any number of threads at once.
class ArrivalsPool {
 public:
  explicit ArrivalsPool(PatchIndex patch_count) : patch_count_(patch_count) {}
  std::unique_ptr<Arrivals> Borrow();
  // Requires: nothing has arrived since the last Take.
  void Return(std::unique_ptr<Arrivals> arrivals);

 private:
  const PatchIndex patch_count_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Arrivals>> idle_;  // guarded by mutex_
};

}  // namespace lambert

#include "radiosity/shoot/arrivals.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lambert {

std::vector<Deposit> Arrivals::Take() {
  if (hit_.size() > cells_.size() / 8) {
    // So many are sooner found in order than sorted.
    hit_.resize(cells_.size());
    std::iota(hit_.begin(), hit_.end(), 0);
  } else {
    std::sort(hit_.begin(), hit_.end());
  }
  std::vector<Deposit> deposits;
  deposits.reserve(hit_.size());
  for (PatchIndex patch : hit_) {
    Cell& cell = cells_[patch];
    if (cell.hits == 0) continue;
    deposits.push_back({cell.r, cell.g, cell.b, cell.hits, patch});
    cell = {};
  }
  hit_.clear();
  return deposits;
}

std::unique_ptr<Arrivals> ArrivalsPool::Borrow() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<Arrivals> arrivals = std::move(idle_.back());
      idle_.pop_back();
      return arrivals;
    }
  }
  return std::make_unique<Arrivals>(patch_count_);
}

void ArrivalsPool::Return(std::unique_ptr<Arrivals> arrivals) {
  std::lock_guard<std::mutex> lock(mutex_);
  idle_.push_back(std::move(arrivals));
}

}  // namespace lambert

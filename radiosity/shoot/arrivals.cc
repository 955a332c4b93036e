#include "radiosity/shoot/arrivals.h"

#include <bit>
#include <utility>

namespace lambert {

Deposit Arrivals::TakeFrom(PatchIndex patch) {
  if (gray_cells_.empty()) {
    const Long4 cell = std::exchange(cells_[patch], Long4{});
    return {cell[0], cell[1], cell[2], cell[3], patch};
  }
  const Long2 cell = std::exchange(gray_cells_[patch], Long2{});
  return {cell[0], 0, 0, cell[1], patch};
}

std::vector<Deposit> Arrivals::Take() {
  std::vector<Deposit> deposits;
  deposits.reserve(hit_count_);
  for (size_t w = 0; w < hit_words_.size(); ++w) {
    for (uint64_t words = std::exchange(hit_words_[w], 0); words != 0; words &= words - 1) {
      const size_t word = 64 * w + static_cast<size_t>(std::countr_zero(words));
      for (uint64_t bits = hit_[word]; bits != 0; bits &= bits - 1) {
        Prefetch(static_cast<PatchIndex>(64 * word) + std::countr_zero(bits));
      }
      for (uint64_t bits = std::exchange(hit_[word], 0); bits != 0; bits &= bits - 1) {
        deposits.push_back(TakeFrom(static_cast<PatchIndex>(64 * word) + std::countr_zero(bits)));
      }
    }
  }
  hit_count_ = 0;
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
  return std::make_unique<Arrivals>(patch_count_, channels_);
}

void ArrivalsPool::Return(std::unique_ptr<Arrivals> arrivals) {
  std::lock_guard<std::mutex> lock(mutex_);
  idle_.push_back(std::move(arrivals));
}

}  // namespace lambert

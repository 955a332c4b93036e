// Where the rays of a unit arrive: dense while they do, a list of the patches that were hit after.
// Which were hit is kept in two levels of bits: the list comes in order without sorting or a walk
// over all patches.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "radiosity/core/lanes.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/unit.h"

namespace lambert {

// One thread at a time.
class Arrivals {
 public:
  // channels: of the unit.
  explicit Arrivals(PatchIndex patch_count, int channels = kColorChannels)
      : cells_(channels == kColorChannels ? patch_count : 0),
        gray_cells_(channels == kGrayChannels ? patch_count : 0),
        hit_(patch_count / 64 + 1),
        hit_words_(hit_.size() / 64 + 1) {}

  // Requires: 0 <= patch < patch_count.
  void Prefetch(PatchIndex patch) const {
    if (gray_cells_.empty()) {
      __builtin_prefetch(&cells_[patch], 1);
    } else {
      __builtin_prefetch(&gray_cells_[patch], 1);
    }
  }
  // r, g, b and the number of rays, which is over 0.
  void Add(PatchIndex patch, Long4 quanta) {
    if (gray_cells_.empty()) {
      Long4& cell = cells_[patch];
      if (cell[3] == 0) Mark(patch);
      cell += quanta;
    } else {
      Long2& cell = gray_cells_[patch];
      if (cell[1] == 0) Mark(patch);
      cell += Long2{quanta[0], quanta[3]};
    }
  }
  void Add(PatchIndex patch, int64_t r, int64_t g, int64_t b) { Add(patch, Long4{r, g, b, 1}); }

  // What arrived, in the order of patches; nothing has arrived after.
  std::vector<Deposit> Take();

 private:
  Deposit TakeFrom(PatchIndex patch);
  void Mark(PatchIndex patch) {
    const uint32_t p = static_cast<uint32_t>(patch), word = p / 64;
    hit_[word] |= uint64_t{1} << p % 64;
    hit_words_[word / 64] |= uint64_t{1} << word % 64;
    ++hit_count_;
  }

  std::vector<Long4> cells_;         // an arrival touches one cache line
  std::vector<Long2> gray_cells_;    // the same of gray light: r and the rays; one of both is empty
  std::vector<uint64_t> hit_;        // bit k of word w: patch 64 w + k was hit
  std::vector<uint64_t> hit_words_;  // bit k of word w: word 64 w + k of hit_ is not 0
  size_t hit_count_ = 0;
};

// Keeps Arrivals for reuse: filling megabytes with zeros for a unit of few rays would take longer
// than tracing them. Any number of threads at once.
class ArrivalsPool {
 public:
  ArrivalsPool(PatchIndex patch_count, int channels)
      : patch_count_(patch_count), channels_(channels) {}
  std::unique_ptr<Arrivals> Borrow();
  // Requires: nothing has arrived since the last Take.
  void Return(std::unique_ptr<Arrivals> arrivals);

 private:
  const PatchIndex patch_count_;
  const int channels_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Arrivals>> idle_;  // guarded by mutex_
};

}  // namespace lambert

// Which grains of a step are in no unit yet: runs of them, cut from where each worker likes to be.
#pragma once

#include <vector>

namespace lambert::server {

// Some grains, one after the other.
struct GrainRange {
  int first = 0, count = 0;
  bool operator==(const GrainRange&) const = default;
};

// A set of grains. Copied cheaply: as many runs as workers have begun at, and one more.
class GrainRuns {
 public:
  GrainRuns() = default;
  // Grains [0, count).
  explicit GrainRuns(int count);

  int count() const { return count_; }
  const std::vector<GrainRange>& runs() const { return runs_; }
  // The longest range that begins with the first grain from `home` on, or, where there is none,
  // with the first of all. Requires: count() > 0.
  GrainRange From(int home) const;
  // Requires: they are there, in one run.
  void Take(const GrainRange& range);

 private:
  std::vector<GrainRange> runs_;  // in order, with gaps between, none empty
  int count_ = 0;
};

}  // namespace lambert::server

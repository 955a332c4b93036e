#include "server/work/grain_runs.h"

#include <algorithm>

namespace lambert::server {
namespace {

int EndOf(const GrainRange& run) { return run.first + run.count; }

// The first run that reaches beyond a grain.
template <typename Runs>
auto Beyond(Runs& runs, int grain) {
  return std::upper_bound(runs.begin(), runs.end(), grain,
                          [](int wanted, const GrainRange& run) { return wanted < EndOf(run); });
}

}  // namespace

GrainRuns::GrainRuns(int count) : count_(count) {
  if (count > 0) runs_.push_back({0, count});
}

GrainRange GrainRuns::From(int home) const {
  const auto run = Beyond(runs_, home);
  if (run == runs_.end()) return runs_.front();
  const int first = std::max(home, run->first);
  return {first, EndOf(*run) - first};
}

void GrainRuns::Take(const GrainRange& range) {
  const auto run = Beyond(runs_, range.first);
  const GrainRange before{run->first, range.first - run->first};
  const GrainRange after{EndOf(range), EndOf(*run) - EndOf(range)};
  auto at = runs_.erase(run);
  if (after.count > 0) at = runs_.insert(at, after);
  if (before.count > 0) runs_.insert(at, before);
  count_ -= range.count;
}

}  // namespace lambert::server

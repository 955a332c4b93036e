#include "server/work/work_load.h"

#include <numeric>

namespace lambert::server {
namespace {

// Of the order of what a core takes with 10,000 to 1,000,000 patches.
constexpr double kUnknownSecondsPerRay = 1e-6;

int64_t QueuedRays(const StepState& step) {
  int64_t rays = 0;
  for (const GrainRange& run : step.uncut.runs()) {
    const auto first = step.grain_rays.begin() + run.first;
    rays = std::accumulate(first, first + run.count, rays);
  }
  for (const int unit : step.open) rays += step.units[unit].rays;
  return rays;
}

}  // namespace

WorkLoad LoadOf(const WorkState& state) {
  WorkLoad load;
  for (const auto& [job, step] : state.steps) {
    const int64_t rays = QueuedRays(step);
    auto pace = state.paces.find(job);
    load.queued_rays += rays;
    load.queued_seconds +=
        static_cast<double>(rays) *
        (pace == state.paces.end() ? kUnknownSecondsPerRay : pace->second.seconds_per_ray.median);
  }
  load.leases = static_cast<int>(state.leases.size());
  load.workers = static_cast<int>(state.sessions.size());
  for (const auto& [name, session] : state.sessions) load.slots += session.slots;
  return load;
}

}  // namespace lambert::server

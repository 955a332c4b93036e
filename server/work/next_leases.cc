#include "server/work/next_leases.h"

#include <algorithm>
#include <utility>

namespace lambert::server {
namespace {

// A waiting session while grants are dealt.
struct Taker {
  const std::string* name;
  const SessionState* session;
  int free;      // slots; -1 when it also has the one unit beyond them
  double share;  // of its slots that are free: the largest takes first
};

// What nobody works on, of all jobs, taken from the jobs in turn.
class OpenWork {
 public:
  OpenWork(const WorkState& state, const WorkOptions& options) : options_(options) {
    for (const auto& [name, session] : state.sessions) {
      if (!session.draining) slots_ += session.slots;
    }
    for (const auto& [job, step] : state.steps) {
      const int grains = static_cast<int>(step.grain_rays.size()) - step.next_grain;
      if (step.open.empty() && grains == 0) continue;
      queues_.push_back({&job, &step, 0, step.next_grain, static_cast<int>(step.leased.size())});
      count_ += static_cast<int>(step.open.size()) + grains;
    }
  }
  // Grains that are left, and units that opened again.
  int count() const { return count_; }
  // Requires: count() > 0. Takes from the job that holds the fewest leases.
  Grant TakeFor(const std::string& session) {
    Queue* best = nullptr;
    for (Queue& queue : queues_) {
      if (queue.IsEmpty()) continue;
      if (best == nullptr || queue.leased < best->leased) best = &queue;
    }
    ++best->leased;
    if (best->next_open < best->step->open.size()) {
      --count_;
      return {session, *best->job, best->step->open[best->next_open++], 0};
    }
    const int grains = NewUnitSize(*best);
    best->next_grain += grains;
    count_ -= grains;
    return {session, *best->job, -1, grains};
  }

 private:
  struct Queue {
    const std::string* job;
    const StepState* step;
    size_t next_open;
    int next_grain;
    int leased;
    bool IsEmpty() const {
      return next_open == step->open.size() &&
             next_grain == static_cast<int>(step->grain_rays.size());
    }
  };
  int NewUnitSize(const Queue& queue) const {
    const std::vector<int64_t>& rays = queue.step->grain_rays;
    const int left = static_cast<int>(rays.size()) - queue.next_grain;
    const int wanted = std::max(1, left / (2 * std::max(slots_, 1)));
    int64_t sum = rays[queue.next_grain];
    int count = 1;
    while (count < wanted && sum + rays[queue.next_grain + count] <= options_.max_unit_rays) {
      sum += rays[queue.next_grain + count++];
    }
    return count;
  }

  const WorkOptions& options_;
  int slots_ = 0;  // of all workers
  std::vector<Queue> queues_;
  int count_ = 0;
};

std::vector<Taker> WaitingTakers(const WorkState& state) {
  std::vector<Taker> takers;
  for (const auto& [name, session] : state.sessions) {
    if (!session.waiting || session.draining) continue;
    const int free = std::max(session.FreeSlots(), -1);
    takers.push_back({&name, &session, free, static_cast<double>(free) / session.slots});
  }
  return takers;
}

// Free slots of workers that are on their way to ask.
int FreeSlotsElsewhere(const WorkState& state) {
  int free = 0;
  for (const auto& [name, session] : state.sessions) {
    if (!session.waiting && !session.draining) free += std::max(session.FreeSlots(), 0);
  }
  return free;
}

void FillSlots(std::vector<Taker>& takers, OpenWork& open, std::vector<Grant>& grants) {
  while (open.count() > 0) {
    auto taker = std::max_element(takers.begin(), takers.end(),
                                  [](const Taker& a, const Taker& b) { return a.share < b.share; });
    if (taker == takers.end() || taker->free <= 0) return;
    grants.push_back(open.TakeFor(*taker->name));
    --taker->free;
    taker->share = static_cast<double>(taker->free) / taker->session->slots;
  }
}

bool Holds(const WorkState& state, const SessionState& session, const UnitRef& unit) {
  return std::any_of(session.leases.begin(), session.leases.end(), [&](const std::string& lease) {
    const LeaseState& held = state.leases.at(lease);
    return !held.revoked && held.unit == unit;
  });
}

// Late units with the time of their newest lease, the oldest first.
std::vector<std::pair<TimePoint, UnitRef>> LateUnits(const WorkState& state, TimePoint now,
                                                     const WorkOptions& options) {
  std::vector<std::pair<TimePoint, UnitRef>> late;
  for (const auto& [job, step] : state.steps) {
    for (int unit : step.leased) {
      TimePoint newest = TimePoint::min();
      for (const std::string& lease : step.units[unit].leases) {
        newest = std::max(newest, state.leases.at(lease).granted);
      }
      if (now - newest >= LateAfter(state, job, step.units[unit].rays, options)) {
        late.push_back({newest, {job, unit}});
      }
    }
  }
  std::sort(late.begin(), late.end());
  return late;
}

}  // namespace

Duration LateAfter(const WorkState& state, const std::string& job, int64_t rays,
                   const WorkOptions& options) {
  auto pace = state.seconds_per_ray.find(job);
  if (pace == state.seconds_per_ray.end()) return options.straggler_unknown;
  const auto expected = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(
      std::min(options.straggler_factor * pace->second * static_cast<double>(rays), 1e6)));
  return std::max(expected, options.straggler_floor);
}

std::vector<Grant> NextLeases(const WorkState& state, TimePoint now, const WorkOptions& options) {
  std::vector<Grant> grants;
  std::vector<Taker> takers = WaitingTakers(state);
  if (takers.empty()) return grants;
  OpenWork open(state, options);
  FillSlots(takers, open, grants);
  const int elsewhere = FreeSlotsElsewhere(state);
  for (Taker& taker : takers) {
    if (taker.free != 0 || open.count() <= elsewhere) continue;
    grants.push_back(open.TakeFor(*taker.name));
    taker.free = -1;
  }
  if (open.count() > 0) return grants;
  if (std::none_of(takers.begin(), takers.end(), [](const Taker& t) { return t.free > 0; })) {
    return grants;
  }
  for (const auto& [granted, unit] : LateUnits(state, now, options)) {
    for (Taker& taker : takers) {
      if (taker.free <= 0 || Holds(state, *taker.session, unit)) continue;
      grants.push_back({*taker.name, unit.job, unit.unit, 0});
      --taker.free;
      break;
    }
  }
  return grants;
}

}  // namespace lambert::server

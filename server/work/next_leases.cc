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

// Open units of all jobs, taken from the jobs in turn.
class OpenUnits {
 public:
  explicit OpenUnits(const WorkState& state) {
    for (const auto& [job, step] : state.steps) {
      if (step.open.empty()) continue;
      queues_.push_back({&job, &step.open, 0, static_cast<int>(step.leased.size())});
      count_ += static_cast<int>(step.open.size());
    }
  }
  int count() const { return count_; }
  // Requires: count() > 0. Takes from the job that holds the fewest leases.
  UnitRef Take() {
    Queue* best = nullptr;
    for (Queue& queue : queues_) {
      if (queue.next == queue.open->size()) continue;
      if (best == nullptr || queue.leased < best->leased) best = &queue;
    }
    ++best->leased;
    --count_;
    return {*best->job, (*best->open)[best->next++]};
  }

 private:
  struct Queue {
    const std::string* job;
    const std::deque<int>* open;
    size_t next;
    int leased;
  };
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

void FillSlots(std::vector<Taker>& takers, OpenUnits& open, std::vector<Grant>& grants) {
  while (open.count() > 0) {
    auto taker = std::max_element(takers.begin(), takers.end(), [](const Taker& a, const Taker& b) {
      return a.share < b.share;
    });
    if (taker == takers.end() || taker->free <= 0) return;
    grants.push_back({*taker->name, open.Take()});
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
  OpenUnits open(state);
  FillSlots(takers, open, grants);
  const int elsewhere = FreeSlotsElsewhere(state);
  for (Taker& taker : takers) {
    if (taker.free != 0 || open.count() <= elsewhere) continue;
    grants.push_back({*taker.name, open.Take()});
    taker.free = -1;
  }
  if (open.count() > 0) return grants;
  if (std::none_of(takers.begin(), takers.end(), [](const Taker& t) { return t.free > 0; })) {
    return grants;
  }
  for (const auto& [granted, unit] : LateUnits(state, now, options)) {
    for (Taker& taker : takers) {
      if (taker.free <= 0 || Holds(state, *taker.session, unit)) continue;
      grants.push_back({*taker.name, unit});
      --taker.free;
      break;
    }
  }
  return grants;
}

}  // namespace lambert::server

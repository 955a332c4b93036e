#include "server/work/next_leases.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

namespace lambert::server {
namespace {

// A waiting session while grants are dealt.
struct Taker {
  const std::string* name;
  const SessionState* session;
  int free;              // slots; less what it has beyond them; one of all where units failed
  bool is_done = false;  // nothing that is open is for it

  double Share() const { return static_cast<double>(free) / session->slots; }
};

// What nobody works on, of all jobs, taken from the jobs in turn.
class OpenWork {
 public:
  OpenWork(const WorkState& state, const WorkOptions& options) : state_(state), options_(options) {
    for (const auto& [name, session] : state.sessions) {
      if (!session.draining) slots_ += session.slots;
    }
    for (const auto& [job, step] : state.steps) {
      const int grains = static_cast<int>(step.grain_rays.size()) - step.next_grain;
      if (step.open.empty() && grains == 0) continue;
      queues_.push_back(
          {&job, &step, step.open, step.next_grain, static_cast<int>(step.leased.size())});
      count_ += static_cast<int>(step.open.size()) + grains;
    }
  }
  // Grains that are left, and units that opened again.
  int count() const { return count_; }
  // Takes from the job that holds the fewest leases; nothing where all that is open failed there.
  std::optional<Grant> TakeFor(const std::string& session) {
    Queue* best = nullptr;
    for (Queue& queue : queues_) {
      if (best != nullptr && queue.leased >= best->leased) continue;
      if (queue.GrainsLeft() > 0 || FirstOpen(queue, session) < queue.open.size()) best = &queue;
    }
    if (best == nullptr) return std::nullopt;
    ++best->leased;
    const size_t open = FirstOpen(*best, session);
    if (open < best->open.size()) {
      const int unit = best->open[open];
      best->open.erase(best->open.begin() + static_cast<ptrdiff_t>(open));
      --count_;
      return Grant{session, *best->job, unit, 0};
    }
    const int grains = NewUnitSize(*best);
    best->next_grain += grains;
    count_ -= grains;
    return Grant{session, *best->job, -1, grains};
  }

 private:
  struct Queue {
    const std::string* job;
    const StepState* step;
    std::deque<int> open;
    int next_grain;
    int leased;
    int GrainsLeft() const { return static_cast<int>(step->grain_rays.size()) - next_grain; }
  };
  // The first open unit that the session may have: not where it failed, while another could do it.
  size_t FirstOpen(const Queue& queue, const std::string& session) const {
    size_t i = 0;
    while (i < queue.open.size() && IsBarred(queue.step->units[queue.open[i]], session)) ++i;
    return i;
  }
  bool IsBarred(const UnitState& unit, const std::string& session) const {
    if (unit.failed_on.count(session) == 0) return false;
    return std::any_of(state_.sessions.begin(), state_.sessions.end(), [&](const auto& other) {
      return !other.second.draining && unit.failed_on.count(other.first) == 0;
    });
  }
  int NewUnitSize(const Queue& queue) const {
    const std::vector<int64_t>& rays = queue.step->grain_rays;
    const int left = queue.GrainsLeft();
    const int wanted = std::max(1, left / (2 * std::max(slots_, 1)));
    int64_t sum = rays[queue.next_grain];
    int count = 1;
    while (count < wanted && sum + rays[queue.next_grain + count] <= options_.max_unit_rays) {
      sum += rays[queue.next_grain + count++];
    }
    return count;
  }

  const WorkState& state_;
  const WorkOptions& options_;
  int slots_ = 0;  // of all workers
  std::vector<Queue> queues_;
  int count_ = 0;
};

std::vector<Taker> WaitingTakers(const WorkState& state, TimePoint now) {
  std::vector<Taker> takers;
  for (const auto& [name, session] : state.sessions) {
    if (!session.waiting || session.draining || now < session.rests_until) continue;
    const int held = static_cast<int>(session.leases.size());
    takers.push_back({&name, &session, session.failures > 0 ? 1 - held : session.FreeSlots()});
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

// Gives open work to the emptiest takers, as long as one has more than `least` slots free and more
// is open than `spared`.
void Fill(std::vector<Taker>& takers, const std::function<int(const Taker&)>& least, int spared,
          OpenWork& open, std::vector<Grant>& grants) {
  while (open.count() > spared) {
    Taker* best = nullptr;
    for (Taker& taker : takers) {
      if (taker.is_done || taker.free <= least(taker)) continue;
      if (best == nullptr || taker.Share() > best->Share()) best = &taker;
    }
    if (best == nullptr) return;
    std::optional<Grant> grant = open.TakeFor(*best->name);
    if (grant.has_value()) {
      grants.push_back(*std::move(grant));
      --best->free;
    } else {
      best->is_done = true;
    }
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
  auto pace = state.paces.find(job);
  if (pace == state.paces.end()) return options.straggler_unknown;
  const auto expected = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(
      std::min(options.straggler_factor * pace->second.median * static_cast<double>(rays), 1e6)));
  return std::max(expected, options.straggler_floor);
}

std::vector<Grant> NextLeases(const WorkState& state, TimePoint now, const WorkOptions& options) {
  std::vector<Grant> grants;
  std::vector<Taker> takers = WaitingTakers(state, now);
  if (takers.empty()) return grants;
  OpenWork open(state, options);
  Fill(
      takers, [](const Taker&) { return 0; }, 0, open, grants);
  Fill(
      takers,
      [&](const Taker& taker) {
        return taker.session->failures > 0 ? 0
                                           : -(options.units_per_slot - 1) * taker.session->slots;
      },
      FreeSlotsElsewhere(state), open, grants);
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

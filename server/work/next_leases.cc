#include "server/work/next_leases.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
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
    for (const auto& [job, step] : state.steps) {
      if (step.open.empty() && step.uncut.count() == 0) continue;
      const int most = MostSessions(step, state.roster, options);
      for_all_ = for_all_ || most >= state.roster.sessions;
      queues_.push_back({&job,
                         &step,
                         step.open,
                         step.uncut,
                         static_cast<int>(step.leased.size()),
                         static_cast<size_t>(most),
                         {}});
      count_ += static_cast<int>(step.open.size()) + step.uncut.count();
    }
  }
  // Grains that are left, and units that opened again.
  int count() const { return count_; }
  // Some of it is for whoever comes.
  bool for_all() const { return for_all_; }
  // Sessions that may get some: all that wait, or the few that hold some already, where every step
  // has as many as it is worth.
  std::set<std::string> Candidates() const {
    std::set<std::string> few;
    for (const Queue& queue : queues_) {
      if (queue.step->holders.size() < queue.most_sessions) return state_.roster.takers;
      for (const auto& [session, count] : queue.step->holders) few.insert(session);
    }
    return few;
  }
  // Takes from the job that holds the fewest leases; nothing where all that is open failed there,
  // or stays with others.
  std::optional<Grant> TakeFor(const std::string& session) {
    Queue* best = nullptr;
    for (Queue& queue : queues_) {
      if (best != nullptr && queue.leased >= best->leased) continue;
      if (!queue.MayJoin(session)) continue;
      if (queue.uncut.count() > 0 || FirstOpen(queue, session) < queue.open.size()) best = &queue;
    }
    if (best == nullptr) return std::nullopt;
    ++best->leased;
    if (best->step->holders.count(session) == 0) best->joined.insert(session);
    const size_t open = FirstOpen(*best, session);
    if (open < best->open.size()) {
      const int unit = best->open[open];
      best->open.erase(best->open.begin() + static_cast<ptrdiff_t>(open));
      --count_;
      return Grant{session, *best->job, unit, {}};
    }
    const GrainRange grains =
        NewUnit(*best, best->uncut.From(HomeOf(state_, *best->step, session)));
    best->uncut.Take(grains);
    count_ -= grains.count;
    return Grant{session, *best->job, -1, grains};
  }

 private:
  struct Queue {
    const std::string* job;
    const StepState* step;
    std::deque<int> open;
    GrainRuns uncut;
    int leased;
    size_t most_sessions;
    std::set<std::string> joined;  // sessions that get some now, and held none before
    bool MayJoin(const std::string& session) const {
      return step->holders.count(session) > 0 || joined.count(session) > 0 ||
             step->holders.size() + joined.size() < most_sessions;
    }
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
  // The first of these grains, as many as make a unit.
  GrainRange NewUnit(const Queue& queue, const GrainRange& free) const {
    const std::vector<int64_t>& rays = queue.step->grain_rays;
    const Roster& roster = state_.roster;
    const auto sessions = std::min<size_t>(queue.most_sessions, roster.sessions);
    const auto slots = static_cast<int>(sessions * roster.slots / std::max(roster.sessions, 1));
    const int wanted = std::clamp(queue.uncut.count() / (2 * std::max(slots, 1)), 1, free.count);
    const int64_t most = std::max(options_.max_unit_rays, queue.step->sums.patches);
    int64_t sum = rays[free.first];
    int count = 1;
    while (count < wanted && sum + rays[free.first + count] <= most) {
      sum += rays[free.first + count++];
    }
    return {free.first, count};
  }

  const WorkState& state_;
  const WorkOptions& options_;
  bool for_all_ = false;
  std::vector<Queue> queues_;
  int count_ = 0;
};

std::vector<Taker> WaitingTakers(const WorkState& state, const std::set<std::string>& candidates,
                                 TimePoint now) {
  std::vector<Taker> takers;
  for (const std::string& name : candidates) {
    auto taker = state.roster.takers.find(name);
    if (taker == state.roster.takers.end()) continue;
    const SessionState& session = state.sessions.at(name);
    if (now < session.rests_until) continue;
    const int held = static_cast<int>(session.leases.size());
    takers.push_back({&*taker, &session, session.failures > 0 ? 1 - held : session.FreeSlots()});
  }
  return takers;
}

// Gives open work to the emptiest takers, as long as one has more than `least` slots free and more
// is open than `spared`.
void Fill(std::vector<Taker>& takers, const std::function<int(const Taker&)>& least, int spared,
          OpenWork& open, std::vector<Grant>& grants) {
  const auto is_after = [](const Taker* a, const Taker* b) {
    return a->Share() < b->Share() || (a->Share() == b->Share() && a > b);
  };
  std::vector<Taker*> wanting;
  for (Taker& taker : takers) {
    if (!taker.is_done && taker.free > least(taker)) wanting.push_back(&taker);
  }
  std::make_heap(wanting.begin(), wanting.end(), is_after);
  while (open.count() > spared && !wanting.empty()) {
    std::pop_heap(wanting.begin(), wanting.end(), is_after);
    Taker* best = wanting.back();
    std::optional<Grant> grant = open.TakeFor(*best->name);
    best->is_done = !grant.has_value();
    if (grant.has_value()) {
      grants.push_back(*std::move(grant));
      --best->free;
    }
    if (best->is_done || best->free <= least(*best)) {
      wanting.pop_back();
    } else {
      std::push_heap(wanting.begin(), wanting.end(), is_after);
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
  const double expected_s =
      pace->second.seconds_per_ray.median * static_cast<double>(rays) + pace->second.wait_s.median;
  const auto late = std::chrono::duration_cast<Duration>(
      std::chrono::duration<double>(std::min(options.straggler_factor * expected_s, 1e6)));
  return std::max(late, options.straggler_floor);
}

int MostSessions(const StepState& step, const Roster& roster, const WorkOptions& options) {
  if (step.sums.patches == 0 || roster.slots == 0) return std::numeric_limits<int>::max();
  const double rays_per_patch =
      static_cast<double>(step.rays) / static_cast<double>(step.sums.patches);
  const double slots = static_cast<double>(roster.slots) / roster.sessions;
  const double most =
      std::sqrt(step.sums.mergers * rays_per_patch / (options.rays_per_sum * slots));
  return static_cast<int>(std::clamp(std::ceil(most), 1.0, 1e9));
}

std::vector<Grant> NextLeases(const WorkState& state, TimePoint now, const WorkOptions& options) {
  std::vector<Grant> grants;
  OpenWork open(state, options);
  if (open.count() == 0) return grants;
  std::vector<Taker> takers = WaitingTakers(state, open.Candidates(), now);
  Fill(
      takers, [](const Taker&) { return 0; }, 0, open, grants);
  Fill(
      takers,
      [](const Taker& taker) {
        return taker.session->failures > 0 ? 0 : taker.session->slots - taker.session->most_leases;
      },
      open.for_all() ? state.roster.free_elsewhere : 0, open, grants);
  return grants;
}

std::vector<Grant> RepeatLate(const WorkState& state, TimePoint now, const WorkOptions& options) {
  std::vector<Grant> grants;
  std::vector<Taker> takers = WaitingTakers(state, state.roster.takers, now);
  std::erase_if(takers, [](const Taker& taker) { return taker.free <= 0; });
  if (takers.empty()) return grants;
  for (const auto& [granted, unit] : LateUnits(state, now, options)) {
    for (Taker& taker : takers) {
      if (taker.free <= 0 || Holds(state, *taker.session, unit)) continue;
      grants.push_back({*taker.name, unit.job, unit.unit, {}});
      --taker.free;
      break;
    }
  }
  return grants;
}

}  // namespace lambert::server

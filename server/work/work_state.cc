#include "server/work/work_state.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lambert::server {
namespace {

// Units that a job's pace is the median of.
constexpr size_t kPaceUnits = 15;

void Learn(double seconds, RecentMedian& pace) {
  pace.recent.push_back(seconds);
  if (pace.recent.size() > kPaceUnits) pace.recent.pop_front();
  std::vector<double> sorted(pace.recent.begin(), pace.recent.end());
  const auto middle = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  pace.median = *middle;
}

void LetGo(StepState& step, const std::string& session) {
  auto holder = step.holders.find(session);
  if (--holder->second == 0) step.holders.erase(holder);
}

void RevokeAll(WorkState& state, StepState& step, UnitState& unit) {
  for (const std::string& name : unit.leases) {
    LeaseState& lease = state.leases.at(name);
    lease.revoked = true;
    LetGo(step, lease.session);
    state.revoked.push_back(name);
  }
  unit.leases.clear();
}

// Adds a session to the roster, or takes it off.
void Count(WorkState& state, const std::string& name, const SessionState& session, int sign) {
  if (session.draining) return;
  Roster& roster = state.roster;
  roster.sessions += sign;
  roster.slots += sign * session.slots;
  if (!session.waiting) {
    roster.free_elsewhere += sign * std::max(session.FreeSlots(), 0);
  } else if (sign < 0) {
    roster.takers.erase(name);
  } else if (static_cast<int>(session.leases.size()) < session.most_leases) {
    roster.takers.insert(name);
  }
}

template <typename Change>
void ChangeSession(WorkState& state, const std::string& name, const Change& change) {
  SessionState& session = state.sessions.at(name);
  Count(state, name, session, -1);
  change(session);
  Count(state, name, session, 1);
}

}  // namespace

void AddSession(WorkState& state, const std::string& name, const std::string& worker_id, int slots,
                const WorkOptions& options) {
  SessionState& session = state.sessions[name];
  session.worker_id = worker_id;
  session.slots = slots;
  session.most_leases = slots * options.units_per_slot;
  session.seat = state.seats.size();
  state.seats.push_back(name);
  Count(state, name, session, 1);
}

void RemoveSession(WorkState& state, const std::string& name) {
  Count(state, name, state.sessions.at(name), -1);
  const size_t seat = state.sessions.at(name).seat;
  state.seats[seat] = state.seats.back();
  state.sessions.at(state.seats[seat]).seat = seat;
  state.seats.pop_back();
  state.sessions.erase(name);
}

void SetWaiting(WorkState& state, const std::string& name, bool waiting) {
  ChangeSession(state, name, [waiting](SessionState& session) { session.waiting = waiting; });
}

void SetDraining(WorkState& state, const std::string& name, bool draining) {
  ChangeSession(state, name, [draining](SessionState& session) { session.draining = draining; });
}

void AddStep(WorkState& state, const std::string& job, int64_t number,
             const std::vector<int64_t>& grain_rays, const SumSize& sums) {
  StepState& step = state.steps[job];
  step.number = number;
  step.grain_rays = grain_rays;
  step.rays = std::accumulate(grain_rays.begin(), grain_rays.end(), int64_t{0});
  step.uncut = GrainRuns(static_cast<int>(grain_rays.size()));
  step.sums = sums;
}

int HomeOf(const WorkState& state, const StepState& step, const std::string& session) {
  return static_cast<int>(state.sessions.at(session).seat * step.grain_rays.size() /
                          state.seats.size());
}

int CutUnit(WorkState& state, const std::string& job, const GrainRange& grains) {
  StepState& step = state.steps.at(job);
  UnitState& unit = step.units.emplace_back();
  unit.grains = grains;
  const auto first = step.grain_rays.begin() + grains.first;
  unit.rays = std::accumulate(first, first + grains.count, int64_t{0});
  step.uncut.Take(grains);
  return static_cast<int>(step.units.size()) - 1;
}

void RemoveStep(WorkState& state, const std::string& job) {
  auto step = state.steps.find(job);
  if (step == state.steps.end()) return;
  for (UnitState& unit : step->second.units) RevokeAll(state, step->second, unit);
  state.steps.erase(step);
}

void AddLease(WorkState& state, const UnitRef& unit, const std::string& session,
              const std::string& lease, TimePoint now) {
  StepState& step = state.steps.at(unit.job);
  state.leases[lease] = {unit, step.number, session, now};
  ChangeSession(state, session, [&lease](SessionState& held) { held.leases.insert(lease); });
  ++step.holders[session];
  step.units[unit.unit].leases.insert(lease);
  step.leased.insert(unit.unit);
  std::erase(step.open, unit.unit);
}

void RemoveLease(WorkState& state, const std::string& lease, bool failed) {
  auto found = state.leases.find(lease);
  if (found == state.leases.end()) return;
  const LeaseState held = found->second;
  state.leases.erase(found);
  if (state.sessions.count(held.session) > 0) {
    ChangeSession(state, held.session, [&](SessionState& session) { session.leases.erase(lease); });
  }
  if (held.revoked) return;
  StepState& step = state.steps.at(held.unit.job);
  UnitState& unit = step.units[held.unit.unit];
  unit.leases.erase(lease);
  LetGo(step, held.session);
  if (failed) {
    ++unit.attempts;
    unit.failed_on.insert(held.session);
  }
  if (unit.leases.empty()) {
    step.leased.erase(held.unit.unit);
    step.open.push_front(held.unit.unit);
  }
}

void LetRest(WorkState& state, const std::string& lease, TimePoint now,
             const WorkOptions& options) {
  auto found = state.leases.find(lease);
  if (found == state.leases.end()) return;
  SessionState& session = state.sessions.at(found->second.session);
  Duration rest = options.first_rest;
  for (int i = 0; i < session.failures && rest < options.longest_rest; ++i) rest *= 2;
  session.rests_until = now + std::min(rest, options.longest_rest);
  ++session.failures;
}

void FinishUnit(WorkState& state, const UnitRef& ref, const std::string& digest,
                const std::string& worker, double run_seconds, double lease_seconds) {
  StepState& step = state.steps.at(ref.job);
  UnitState& unit = step.units[ref.unit];
  unit.done = true;
  unit.result_digest = digest;
  unit.result_worker = worker;
  RevokeAll(state, step, unit);
  step.leased.erase(ref.unit);
  std::erase(step.open, ref.unit);
  if (unit.rays <= 0 || !(run_seconds > 0) || !std::isfinite(run_seconds)) return;
  Pace& pace = state.paces[ref.job];
  Learn(run_seconds / static_cast<double>(unit.rays), pace.seconds_per_ray);
  Learn(std::max(lease_seconds - run_seconds, 0.0), pace.wait_s);
}

}  // namespace lambert::server

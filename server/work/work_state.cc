#include "server/work/work_state.h"

#include <algorithm>
#include <cmath>

namespace lambert::server {
namespace {

// Units that a job's pace is the median of.
constexpr size_t kPaceUnits = 15;

void Learn(double seconds_per_ray, Pace& pace) {
  pace.recent.push_back(seconds_per_ray);
  if (pace.recent.size() > kPaceUnits) pace.recent.pop_front();
  std::vector<double> sorted(pace.recent.begin(), pace.recent.end());
  const auto middle = sorted.begin() + static_cast<ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  pace.median = *middle;
}

void RevokeAll(WorkState& state, UnitState& unit) {
  for (const std::string& lease : unit.leases) state.leases.at(lease).revoked = true;
  unit.leases.clear();
}

}  // namespace

void AddStep(WorkState& state, const std::string& job, int64_t number,
             const std::vector<int64_t>& grain_rays) {
  StepState& step = state.steps[job];
  step.number = number;
  step.grain_rays = grain_rays;
}

int CutUnit(WorkState& state, const std::string& job, int grain_count) {
  StepState& step = state.steps.at(job);
  UnitState& unit = step.units.emplace_back();
  unit.first_grain = step.next_grain;
  unit.grain_count = grain_count;
  for (int i = 0; i < grain_count; ++i) unit.rays += step.grain_rays[step.next_grain++];
  return static_cast<int>(step.units.size()) - 1;
}

void RemoveStep(WorkState& state, const std::string& job) {
  auto step = state.steps.find(job);
  if (step == state.steps.end()) return;
  for (UnitState& unit : step->second.units) RevokeAll(state, unit);
  state.steps.erase(step);
}

void AddLease(WorkState& state, const UnitRef& unit, const std::string& session,
              const std::string& lease, TimePoint now) {
  StepState& step = state.steps.at(unit.job);
  state.leases[lease] = {unit, step.number, session, now};
  state.sessions.at(session).leases.insert(lease);
  step.units[unit.unit].leases.insert(lease);
  step.leased.insert(unit.unit);
  std::erase(step.open, unit.unit);
}

void RemoveLease(WorkState& state, const std::string& lease, bool failed) {
  auto found = state.leases.find(lease);
  if (found == state.leases.end()) return;
  const LeaseState held = found->second;
  state.leases.erase(found);
  auto session = state.sessions.find(held.session);
  if (session != state.sessions.end()) session->second.leases.erase(lease);
  if (held.revoked) return;
  StepState& step = state.steps.at(held.unit.job);
  UnitState& unit = step.units[held.unit.unit];
  unit.leases.erase(lease);
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
                const std::string& worker, double run_seconds) {
  StepState& step = state.steps.at(ref.job);
  UnitState& unit = step.units[ref.unit];
  unit.done = true;
  unit.result_digest = digest;
  unit.result_worker = worker;
  RevokeAll(state, unit);
  step.leased.erase(ref.unit);
  std::erase(step.open, ref.unit);
  if (unit.rays <= 0 || !(run_seconds > 0) || !std::isfinite(run_seconds)) return;
  Learn(run_seconds / static_cast<double>(unit.rays), state.paces[ref.job]);
}

}  // namespace lambert::server

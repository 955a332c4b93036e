#include "server/work/work_state.h"

#include <algorithm>
#include <cmath>

namespace lambert::server {
namespace {

// Weight of the newest unit in a job's pace: the mean of about the last eight.
constexpr double kPaceWeight = 0.125;
// A worker that was frozen for a while must not make all others look slow.
constexpr double kMaxPaceRatio = 4;

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
  if (failed) ++unit.attempts;
  if (unit.leases.empty()) {
    step.leased.erase(held.unit.unit);
    step.open.push_front(held.unit.unit);
  }
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
  const double pace = run_seconds / static_cast<double>(unit.rays);
  auto [known, is_new] = state.seconds_per_ray.try_emplace(ref.job, pace);
  const double believed = std::min(pace, kMaxPaceRatio * known->second);
  if (!is_new) known->second += kPaceWeight * (believed - known->second);
}

}  // namespace lambert::server

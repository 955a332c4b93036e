// WorkTable::Submit: what becomes of a result.
#include <cmath>
#include <set>
#include <utility>

#include "radiosity/core/error.h"
#include "server/work/result_bytes.h"
#include "server/work/work_table.h"

namespace lambert::server {
namespace {

void Count(const absl::StatusOr<SubmitOutcome>& outcome, WorkCounters& counters) {
  if (!outcome.ok()) {
    ++counters.results_refused;
  } else if (*outcome == SubmitOutcome::kAccepted) {
    ++counters.results_accepted;
  } else if (*outcome == SubmitOutcome::kDuplicate) {
    ++counters.results_duplicate;
  } else if (*outcome == SubmitOutcome::kObsolete) {
    ++counters.results_obsolete;
  }
}

int64_t Microseconds(double seconds) {
  return seconds > 0 && seconds < 1e9 ? std::llround(seconds * 1e6) : 0;
}

}  // namespace

std::shared_ptr<PublishedStep> WorkTable::FindStep(const std::string& job,
                                                   int64_t step_number) const {
  auto step = steps_.find(job);
  if (step == steps_.end() || step->second->number() != step_number) return nullptr;
  return step->second;
}

int64_t WorkTable::MaxResultBytes(const std::string& job, int64_t step_number) const {
  absl::MutexLock lock(&mutex_);
  std::shared_ptr<PublishedStep> step = FindStep(job, step_number);
  if (step == nullptr) return 0;
  return lambert::server::MaxResultBytes(step->setup().patch_count, step->rays(),
                                         step->setup().has_sightings);
}

std::string WorkTable::WorkerOf(const std::string& lease) const {
  const std::string session = lease.substr(0, lease.find("/leases/"));
  auto found = state_.sessions.find(session);
  return found == state_.sessions.end() ? session + " (ended)" : found->second.worker_id;
}

std::string WorkTable::WorkerOfSession(const std::string& session) const {
  absl::MutexLock lock(&mutex_);
  auto found = state_.sessions.find(session);
  return found == state_.sessions.end() ? "" : found->second.worker_id;
}

absl::StatusOr<SubmitOutcome> WorkTable::Repeated(const Submission& submission,
                                                  const std::string& worker, PublishedStep& step) {
  const UnitState& unit = state_.steps.at(submission.job).units[submission.units[0].unit];
  absl::Status status =
      MakeError(absl::StatusCode::kDataLoss,
                {"NONDETERMINISTIC_RESULT",
                 "unit " + std::to_string(submission.units[0].unit) + " of " + submission.job,
                 "workers " + unit.result_worker + " and " + worker + " computed different results",
                 "take the faulty one of these machines out of service and solve again"});
  step.Abort(status);
  return status;
}

absl::StatusOr<WorkTable::Claim> WorkTable::Examine(const Submission& submission) const {
  absl::MutexLock lock(&mutex_);
  Claim claim;
  claim.worker = WorkerOf(submission.units[0].lease);
  claim.step = FindStep(submission.job, submission.step_number);
  if (claim.step == nullptr) return claim;
  const std::vector<UnitState>& units = state_.steps.at(submission.job).units;
  std::set<int> met;
  for (const SubmittedUnit& submitted : submission.units) {
    const bool is_there = submitted.unit >= 0 && submitted.unit < static_cast<int>(units.size());
    if (!is_there || !met.insert(submitted.unit).second) {
      return MakeError(
          absl::StatusCode::kInvalidArgument,
          {"FIELD_INVALID", "unit_index", "there is no such unit, or it is there twice",
           "use programs of one version"});
    }
    claim.grains.push_back(units[submitted.unit].grains);
  }
  const Known known = Compare(submission);
  claim.is_new = known.done == 0 || (submission.units.size() == 1 && known.equal == 0);
  return claim;
}

WorkTable::Known WorkTable::Compare(const Submission& submission) const {
  Known known;
  for (const SubmittedUnit& submitted : submission.units) {
    const UnitState& unit = state_.steps.at(submission.job).units[submitted.unit];
    known.done += unit.done;
    known.equal += unit.done && unit.result_digest == submitted.digest;
  }
  return known;
}

absl::StatusOr<SubmitOutcome> WorkTable::Book(const Submission& submission, const Claim& claim) {
  const Known known = Compare(submission);
  if (known.equal == submission.units.size()) return SubmitOutcome::kDuplicate;
  if (known.done > 0 && submission.units.size() > 1) return SubmitOutcome::kSplit;
  if (known.done > 0) return Repeated(submission, claim.worker, *claim.step);
  for (const SubmittedUnit& submitted : submission.units) {
    auto lease = state_.leases.find(submitted.lease);
    const double lease_seconds =
        lease == state_.leases.end() ? 0 : ToSeconds(clock_() - lease->second.granted);
    FinishUnit(state_, {submission.job, submitted.unit}, submitted.digest, claim.worker,
               submitted.run_seconds, lease_seconds);
    counters_.rays += state_.steps.at(submission.job).units[submitted.unit].rays;
    counters_.run_microseconds += Microseconds(submitted.run_seconds);
  }
  ++merging_;
  return SubmitOutcome::kAccepted;
}

absl::StatusOr<SubmitOutcome> WorkTable::Settle(const Submission& submission, const Claim& claim,
                                                const absl::Status& checked) {
  const bool is_current =
      claim.step != nullptr && FindStep(submission.job, submission.step_number) == claim.step;
  absl::StatusOr<SubmitOutcome> outcome = SubmitOutcome::kObsolete;
  if (!checked.ok()) {
    outcome = checked;
  } else if (is_current) {
    outcome = Book(submission, claim);
  }
  if (outcome.ok() && *outcome == SubmitOutcome::kSplit) return outcome;
  for (const SubmittedUnit& submitted : submission.units) {
    if (!checked.ok()) FailLease(submitted.lease, std::string(checked.message()));
    auto lease = state_.leases.find(submitted.lease);
    if (lease == state_.leases.end()) continue;
    SessionState& session = state_.sessions.at(lease->second.session);
    if (outcome.ok() && *outcome == SubmitOutcome::kAccepted) ++session.finished_units;
    if (outcome.ok()) session.failures = 0;
    RemoveLease(state_, submitted.lease, /*failed=*/false);
  }
  return outcome;
}

absl::StatusOr<SubmitOutcome> WorkTable::Submit(const Submission& submission) {
  counters_.result_bytes += static_cast<int64_t>(submission.bytes.size());
  absl::StatusOr<Claim> claim = Examine(submission);
  if (!claim.ok()) return claim.status();
  const TimePoint began = clock_();
  // A repetition need not be decoded; one that differs must be sound before it accuses anybody.
  absl::StatusOr<UnitResult> result = UnitResult{};
  if (claim->is_new) {
    result = claim->step->Check(claim->grains, claim->worker, submission.bytes);
  }
  absl::StatusOr<SubmitOutcome> outcome = SubmitOutcome::kObsolete;
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    outcome = Settle(submission, *claim, result.status());
    Dispatch(calls);
  }
  MakeCalls(calls);
  if (outcome.ok() && *outcome == SubmitOutcome::kAccepted) {
    result->cpu_seconds = submission.cpu_seconds;
    claim->step->Merge(*result, claim->grains);
    absl::MutexLock lock(&mutex_);
    --merging_;
  }
  Count(outcome, counters_);
  counters_.merge_microseconds += Microseconds(ToSeconds(clock_() - began));
  return outcome;
}

}  // namespace lambert::server

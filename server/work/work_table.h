// Who works on what: worker sessions, leases, and the steps that jobs publish.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "server/base/clock.h"
#include "server/work/next_leases.h"
#include "server/work/published_step.h"
#include "server/work/shard_table.h"
#include "server/work/work_counters.h"
#include "server/work/work_load.h"
#include "server/work/work_state.h"

namespace lambert::server {

struct LeaseReport {
  std::string lease;
  bool failed = false;
  std::string error_message;
};

struct SyncRequest {
  std::string session;
  int64_t sequence = 0;
  std::vector<LeaseReport> reports;  // every lease that the worker holds
  bool draining = false;
};

struct GrantedLease {
  std::string name;
  std::shared_ptr<const PublishedStep> step;
  int unit = 0;
  GrainRange grains = {};
};

struct SyncReply {
  int64_t sequence = 0;
  std::vector<GrantedLease> leases;
  std::vector<std::string> revoked;
};

// Called exactly once, from any thread, without the table's lock.
using SyncDone = std::function<void(absl::StatusOr<SyncReply>)>;

struct SubmittedUnit {
  std::string lease;
  int unit = 0;
  std::string digest;  // of the unit's own result
  double run_seconds = 0;
};

// A result of one unit, or the sum of those of several. What is said of one holds for each.
struct Submission {
  std::string job;
  int64_t step_number = 0;
  std::vector<SubmittedUnit> units;  // one or more; of one, its digest is checked
  double cpu_seconds = 0;
  std::string bytes;  // EncodeUnitResult
};

// kSplit: some, but not all, of several units have a result; nothing was merged.
enum class SubmitOutcome { kAccepted, kDuplicate, kObsolete, kSplit };

struct WorkerInfo {
  std::string worker_id;
  int slots = 0, leases = 0;
  int64_t finished_units = 0;
  double silence_s = 0;
};

// Thread safe. Results are decoded, checked and merged without the table's lock.
class WorkTable {
 public:
  // `epoch` tells runs of a server apart: step numbers and session names grow with it.
  WorkTable(const WorkOptions& options, std::string unit_version, int64_t epoch, Clock clock);

  const WorkOptions& options() const { return options_; }

  // Returns the session's name. FAILED_PRECONDITION (UNIT_VERSION_UNSUPPORTED), FIELD_INVALID,
  // SHUTTING_DOWN. A session of the same worker ends.
  absl::StatusOr<std::string> OpenSession(const std::string& worker_id, int slots,
                                          const std::string& unit_version);
  // Holds `done` until there are leases or revocations, or the sync interval has passed.
  // SESSION_NOT_FOUND, SEQUENCE_STALE, SHUTTING_DOWN; ABORTED (SYNC_REPLACED) when a newer call of
  // the session comes while this one is held.
  // `call` identifies the call for CancelSync.
  void Sync(const SyncRequest& request, const void* call, SyncDone done);
  // Ends a held call whose caller has gone; does nothing where it is not held any more.
  void CancelSync(const std::string& session, const void* call);
  // Reopens the session's leases, without counting an attempt.
  void CloseSession(const std::string& session);
  // Whose session it is, by worker_id; "" where there is none.
  std::string WorkerOfSession(const std::string& session) const;
  // Most bytes that a result of this step may have; 0 where the step is over.
  int64_t MaxResultBytes(const std::string& job, int64_t step_number) const;
  // RESULT_INVALID: refused, the unit opens again. NONDETERMINISTIC_RESULT: the job's step fails.
  absl::StatusOr<SubmitOutcome> Submit(const Submission& submission);

  // Offers the grains of a step to workers. PublishedStep::Wait then ends with the merged result,
  // or with UNIT_ATTEMPTS_EXHAUSTED, NONDETERMINISTIC_RESULT, SHUTTING_DOWN, or what AbortJob was
  // given; with SHARD_FAILED where a merge shard failed: it is to be published again. Merge shards
  // take its sums where there are any, `may_shard`, and it has as many rays as patches. Requires:
  // at least one grain; the job's step before was withdrawn.
  absl::StatusOr<std::shared_ptr<PublishedStep>> Publish(const WorkSetup& setup,
                                                         const std::vector<WorkUnit>& grains,
                                                         bool may_shard = true);
  // Takes the job's step away; results that still come are obsolete.
  void Withdraw(const std::string& job);
  // Ends the job's step, and each later one, with `status`, until ForgetJob.
  void AbortJob(const std::string& job, const absl::Status& status);
  void ForgetJob(const std::string& job);

  // Whether workers need a blob for a step that is published.
  bool NeedsBlob(const std::string& sha256) const;

  // Ends silent sessions, answers calls held long enough, repeats late units. Call it often (50
  // ms).
  void Tick();
  // Grants nothing any more: held and later calls for work get SHUTTING_DOWN, results are still
  // taken. Blocks until no unit is leased, or `grace` (of real time) has passed.
  void Drain(Duration grace);
  // Ends every step and every held call; later calls fail.
  void Shutdown();

  std::vector<WorkerInfo> ListWorkers() const;
  WorkLoad Load() const;
  const WorkCounters& counters() const { return counters_; }
  ShardTable& shards() { return shards_; }
  const ShardTable& shards() const { return shards_; }

 private:
  // A session's calls, beside its SessionState.
  struct Exchange {
    int64_t sequence = 0;
    SyncDone held;  // null: none
    const void* held_call = nullptr;
    TimePoint answer_by;
    bool answered = false;  // `reply` answered `sequence`
    SyncReply reply;
    std::vector<std::string> revoked;  // to be told
  };
  using Calls = std::vector<std::function<void()>>;  // to be made without the lock

  static void MakeCalls(Calls& calls) {
    for (auto& call : calls) call();
  }
  void ApplyReports(const SyncRequest& request) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Lends what is open, and tells whose leases were revoked.
  void Dispatch(Calls& calls) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Lend(const std::vector<Grant>& grants, Calls& calls) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Answers calls that were held long enough.
  void AnswerOverdue(Calls& calls) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Answer(const std::string& session, std::vector<GrantedLease> leases, Calls& calls)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void EndHeld(Exchange& exchange, const absl::Status& status, Calls& calls)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void StopGranting(Calls& calls) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void EndSession(const std::string& session, bool failed, const std::string& why, Calls& calls)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void FailLease(const std::string& lease, const std::string& why)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Is logged by the next tick, which holds no lock.
  void Note(std::string text, LogSubject about) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // The step that a submission is for, or null where it is over.
  std::shared_ptr<PublishedStep> FindStep(const std::string& job, int64_t step_number) const
      ABSL_SHARED_LOCKS_REQUIRED(mutex_);
  std::string WorkerOf(const std::string& lease) const ABSL_SHARED_LOCKS_REQUIRED(mutex_);
  // What a submission is for, and whether it has to be decoded.
  struct Claim {
    std::shared_ptr<PublishedStep> step;  // null: it is over
    std::string worker;
    bool is_new = false;
    std::vector<GrainRange> grains;
  };
  // How many units of a submission have a result, and how many of those an equal one.
  struct Known {
    size_t done = 0, equal = 0;
  };
  Known Compare(const Submission& submission) const ABSL_SHARED_LOCKS_REQUIRED(mutex_);
  // Books a sound submission of a step that goes on.
  absl::StatusOr<SubmitOutcome> Book(const Submission& submission, const Claim& claim)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  absl::StatusOr<Claim> Examine(const Submission& submission) const;
  // Books a submission whose bytes were checked.
  absl::StatusOr<SubmitOutcome> Settle(const Submission& submission, const Claim& claim,
                                       const absl::Status& checked)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // What becomes of a result of a unit that is done already; fails the step where they differ.
  absl::StatusOr<SubmitOutcome> Repeated(const Submission& submission, const std::string& worker,
                                         PublishedStep& step) ABSL_SHARED_LOCKS_REQUIRED(mutex_);

  const WorkOptions options_;
  const std::string unit_version_;
  const Clock clock_;
  WorkCounters counters_;
  ShardTable shards_;
  mutable absl::Mutex mutex_;
  int64_t next_step_ ABSL_GUARDED_BY(mutex_);
  int64_t next_name_ ABSL_GUARDED_BY(mutex_);
  bool shutting_down_ ABSL_GUARDED_BY(mutex_) = false;
  std::vector<LogLine> notes_ ABSL_GUARDED_BY(mutex_);
  int merging_ ABSL_GUARDED_BY(mutex_) = 0;  // results that are booked and not merged yet
  WorkState state_ ABSL_GUARDED_BY(mutex_);
  std::map<std::string, Exchange> exchanges_ ABSL_GUARDED_BY(mutex_);  // by session
  std::map<std::string, std::shared_ptr<PublishedStep>> steps_ ABSL_GUARDED_BY(mutex_);  // by job
  std::map<std::string, absl::Status> aborted_ ABSL_GUARDED_BY(mutex_);                  // by job
};

}  // namespace lambert::server

// A clock that tests set, units without a scene, and a worker without a network.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "radiosity/core/digest.h"
#include "server/work/work_table.h"

namespace lambert::server {

class FakeClock {
 public:
  void Advance(Duration duration) {
    absl::MutexLock lock(&mutex_);
    now_ += duration;
  }
  Clock clock() {
    return [this] {
      absl::MutexLock lock(&mutex_);
      return now_;
    };
  }

 private:
  absl::Mutex mutex_;
  TimePoint now_ ABSL_GUARDED_BY(mutex_) = TimePoint() + std::chrono::hours(1);
};

inline constexpr PatchIndex kFakePatches = 2;
inline constexpr uint32_t kFakeRays = 10;  // of each unit

inline std::vector<WorkUnit> MakeUnits(int count) {
  std::vector<WorkUnit> units(count);
  for (int i = 0; i < count; ++i) {
    units[i].seed = 1;
    units[i].visits.push_back(
        {0, kFakeRays * count, kFakeRays * i, kFakeRays * (i + 1), {7, 7, 7}});
  }
  return units;
}

inline WorkSetup MakeSetup(const std::string& job) {
  return {job, std::string(64, 'a'), 100, kFakePatches, "options"};
}

// A result of any of the units; `hits` tells results apart.
inline UnitResult MakeResult(int64_t hits = 4) {
  UnitResult result;
  result.deposits = {{5, 5, 5, hits, 0}, {1, 1, 1, 1, 1}};
  result.shot = {7, 7, 7};
  result.escaped = {1, 1, 1};
  result.rays = kFakeRays;
  return result;
}

inline Submission MakeSubmission(const GrantedLease& lease, const UnitResult& result,
                                 double cpu_seconds = 0.01) {
  std::string bytes = EncodeUnitResult(result);
  return {lease.step->setup().job,
          lease.step->number(),
          {{lease.name, lease.unit, Sha256Hex(bytes), cpu_seconds}},
          cpu_seconds,
          bytes};
}

// A result of several units, each of which has that result.
inline Submission Combine(const std::vector<GrantedLease>& leases,
                          const UnitResult& each = MakeResult()) {
  Submission combined = MakeSubmission(leases[0], each);
  combined.units.clear();
  UnitResult sum;
  for (const GrantedLease& lease : leases) {
    MergeResult(each, sum);
    combined.units.push_back(MakeSubmission(lease, each).units[0]);
  }
  combined.bytes = EncodeUnitResult(sum);
  return combined;
}

// Talks to a table as a worker does.
class FakeWorker {
 public:
  FakeWorker(WorkTable* table, const std::string& id, int slots = 1) : table_(table) {
    session_ = table->OpenSession(id, slots, "v1").value_or("");
  }

  // Begins an exchange with the next sequence. Replies arrive in `replies`.
  void Sync() {
    ++sequence_;
    Resend();
  }
  // Repeats the exchange, as after a lost answer.
  void Resend() {
    SyncRequest request{session_, sequence_, reports_, draining_};
    table_->Sync(request, this, [this](absl::StatusOr<SyncReply> reply) {
      if (reply.ok()) Learn(*reply);
      replies.push_back(std::move(reply));
    });
  }
  absl::StatusOr<SubmitOutcome> Submit(const GrantedLease& lease,
                                       const UnitResult& result = MakeResult()) {
    Forget(lease.name);
    return table_->Submit(MakeSubmission(lease, result));
  }
  // Takes a lease off the reports.
  void Forget(const std::string& lease) {
    std::erase_if(reports_, [&](const LeaseReport& report) { return report.lease == lease; });
  }
  void Fail(const std::string& lease, const std::string& why) {
    for (LeaseReport& report : reports_) {
      if (report.lease == lease) report = {lease, true, why};
    }
  }
  void Drain() { draining_ = true; }

  const std::string& session() const { return session_; }
  std::vector<GrantedLease> leases;  // all that were ever granted
  std::vector<std::string> revoked;
  std::vector<absl::StatusOr<SyncReply>> replies;

 private:
  void Learn(const SyncReply& reply) {
    for (const GrantedLease& lease : reply.leases) {
      leases.push_back(lease);
      Forget(lease.name);
      reports_.push_back({lease.name, false, ""});
    }
    for (const std::string& lease : reply.revoked) {
      revoked.push_back(lease);
      Forget(lease);
    }
  }

  WorkTable* const table_;
  std::string session_;
  int64_t sequence_ = 0;
  bool draining_ = false;
  std::vector<LeaseReport> reports_;
};

}  // namespace lambert::server

// The leases that this worker holds: those that wait for a slot and those that run.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "lambert/worker/v1/worker_service.pb.h"
#include "radiosity/core/log.h"

namespace lambert::worker {

// What a log line about a lease is about.
inline LogSubject SubjectOf(const v1::Lease& lease) {
  const v1::UnitKey& unit = lease.unit_key();
  return {unit.solve_job(), unit.step_number(), unit.unit_index()};
}

// Thread safe.
class LeaseBook {
 public:
  void Add(v1::Lease lease);
  // Drops a lease that waits; one that runs goes on, and nobody wants its result.
  void Revoke(const std::string& lease);
  // True for a lease that was taken and is wanted.
  bool IsWanted(const std::string& lease) const;
  // Blocks until a lease waits, and makes it run; nothing once the book is closed.
  std::optional<v1::Lease> Take();
  // The lease's result was sent, or nobody wants it.
  void Remove(const std::string& lease);
  // Running the lease failed: it is reported so, until the report was answered.
  void Fail(const std::string& lease, const std::string& message);

  // Leases that wait, run, or whose result is yet to be sent.
  size_t Unsent() const;
  std::vector<v1::LeaseReport> Reports() const;
  // `reports` have reached the coordinator.
  void Confirm(const std::vector<v1::LeaseReport>& reports);

  // Forgets every lease: their session has ended. Those that run go on unreported.
  void Forget();
  // Drops what waits and takes no more.
  void Close();
  // Blocks until nothing runs. Requires: closed.
  void WaitUntilIdle();

 private:
  mutable absl::Mutex mutex_;
  std::deque<v1::Lease> waiting_ ABSL_GUARDED_BY(mutex_);
  std::map<std::string, v1::LeaseReport> taken_ ABSL_GUARDED_BY(mutex_);  // active and failed
  std::set<std::string> revoked_ ABSL_GUARDED_BY(mutex_);                 // of those taken
  int running_ ABSL_GUARDED_BY(mutex_) = 0;
  bool closed_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace lambert::worker

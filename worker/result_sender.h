// Sends results while the slots go on with the next units. Those that wait meanwhile, one a slot,
// travel as one, their sum: link and coordinator get few and dense results. Where there are merge
// shards those get the sums, and the coordinator the ledger.
#pragma once

#include <deque>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"
#include "lambert/worker/v1/worker_service.pb.h"
#include "radiosity/shoot/unit.h"
#include "worker/lease_book.h"
#include "worker/part_sender.h"
#include "worker/server_link.h"
#include "worker/worker.h"

namespace lambert::worker {

// Thread safe.
class ResultSender {
 public:
  // Holds at most one result a slot, and one more.
  // `on_failed`: a lease was given up because a merge shard cannot be reached.
  ResultSender(ServerLink* link, LeaseBook* book, const WorkerOptions& options,
               std::function<void()> on_failed);
  // Sends what is there.
  ~ResultSender();

  // Takes over a result; blocks while too many wait. The lease leaves the book when it was sent.
  void Send(FinishedUnit unit);
  // From now on a result is offered once only.
  void StopRetrying();

 private:
  using Outcome = v1::SubmitUnitResultResponse::Outcome;
  void Work();
  // One result a slot waits, or nothing else is under way here.
  bool IsTimeToSend() const ABSL_SHARED_LOCKS_REQUIRED(mutex_);
  // The items that wait and are of the step of the first one.
  std::vector<FinishedUnit> TakeBatch() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Fails where the leases have to be given up.
  absl::Status SendAll(const std::vector<FinishedUnit>& units);
  void SendOne(const FinishedUnit& unit);
  // With parts at merge shards: the ledger alone, of one unit or of the sum of several.
  void SendSum(const std::vector<FinishedUnit>& units, const UnitResult& sum);
  // Offers a result until it is answered, or it is of no use to try again.
  absl::StatusOr<Outcome> Offer(v1::SubmitUnitResultRequest header, const UnitResult& result);
  void LogRefusal(const absl::Status& status, const FinishedUnit& unit) const;

  ServerLink* const link_;
  LeaseBook* const book_;
  const WorkerOptions options_;
  const std::function<void()> on_failed_;
  absl::Notification stop_retrying_;
  PartSender parts_;
  absl::Mutex mutex_;
  std::deque<FinishedUnit> items_ ABSL_GUARDED_BY(mutex_);
  size_t sending_ ABSL_GUARDED_BY(mutex_) = 0;  // items
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace lambert::worker

// Sends results while the slots go on with the next units.
#pragma once

#include <deque>
#include <thread>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"
#include "lambert/worker/v1/worker_service.pb.h"
#include "radiosity/shoot/unit.h"
#include "worker/lease_book.h"
#include "worker/server_link.h"
#include "worker/worker.h"

namespace lambert::worker {

// Thread safe.
class ResultSender {
 public:
  // Holds at most one result a slot, and one more.
  ResultSender(ServerLink* link, LeaseBook* book, const WorkerOptions& options);
  // Sends what is there.
  ~ResultSender();

  // Takes over a result; blocks while too many wait. The lease leaves the book when it was sent.
  // `run_seconds`: wall-clock time that the unit took.
  void Send(const v1::Lease& lease, UnitResult result, double run_seconds);
  // From now on a result is offered once only.
  void StopRetrying();

 private:
  struct Item {
    v1::Lease lease;
    UnitResult result;
    double run_seconds = 0;
  };
  void Work();
  void SendOne(const Item& item);

  ServerLink* const link_;
  LeaseBook* const book_;
  const WorkerOptions options_;
  absl::Notification stop_retrying_;
  absl::Mutex mutex_;
  std::deque<Item> items_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::thread thread_;
};

}  // namespace lambert::worker

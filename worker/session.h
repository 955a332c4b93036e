// The session with the coordinator: heartbeat, reports up, leases down, on a thread of its own.
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "absl/synchronization/notification.h"
#include "lambert/worker/v1/worker_service.pb.h"
#include "worker/lease_book.h"
#include "worker/server_link.h"
#include "worker/worker.h"

namespace lambert::worker {

// Opens a session, and a new one whenever the server does not know it any more. Thread safe.
class Session {
 public:
  Session(ServerLink* link, LeaseBook* book, const WorkerOptions& options);
  ~Session();

  // Tells the server at once what has become of the leases.
  void Report();
  // From now on no new leases; those that are not reported any more go back at once.
  void StartDraining();
  // Closes the session.
  void End();

 private:
  void Work();
  bool Open();
  absl::Status Exchange();

  ServerLink* const link_;
  LeaseBook* const book_;
  const WorkerOptions options_;
  absl::Notification draining_, ended_;
  std::atomic<bool> has_news_{false};  // that the server should hear at once
  // Of the thread:
  std::optional<v1::WorkerSession> session_;
  int64_t sequence_ = 1;
  bool refused_ = false;
  std::thread thread_;
};

}  // namespace lambert::worker

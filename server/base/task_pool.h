// A few threads for what would keep gRPC's own threads from answering heartbeats: parsing,
// planning, hashing, fsync.
#pragma once

#include <deque>
#include <functional>
#include <thread>
#include <vector>

#include "absl/synchronization/mutex.h"

namespace lambert::server {

class TaskPool {
 public:
  explicit TaskPool(int threads);
  // Runs what is queued, then joins.
  ~TaskPool();

  // Runs `task` on some thread, in order of arrival. Tasks that block for long starve the others.
  void Run(std::function<void()> task);

 private:
  void Work();

  absl::Mutex mutex_;
  std::deque<std::function<void()>> tasks_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::vector<std::thread> threads_;
};

}  // namespace lambert::server

// Runs jobs in the order in which they came, a few at a time.
#pragma once

#include <deque>
#include <memory>
#include <thread>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "server/jobs/job.h"
#include "server/run/job_runner.h"

namespace lambert::server {

// Thread safe.
class Scheduler {
 public:
  // `threads`: jobs that run at once, > 0.
  Scheduler(JobRunner* runner, int threads);
  // Waits for the jobs that run; starts none of those that wait.
  ~Scheduler();

  void Add(std::shared_ptr<Job> job);

 private:
  void Work();

  JobRunner* const runner_;
  absl::Mutex mutex_;
  std::deque<std::shared_ptr<Job>> queue_ ABSL_GUARDED_BY(mutex_);
  bool stopping_ ABSL_GUARDED_BY(mutex_) = false;
  std::vector<std::thread> threads_;
};

}  // namespace lambert::server

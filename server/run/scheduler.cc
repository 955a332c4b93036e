#include "server/run/scheduler.h"

#include <utility>

namespace lambert::server {

Scheduler::Scheduler(JobRunner* runner, int threads) : runner_(runner) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { Work(); });
}

Scheduler::~Scheduler() {
  {
    absl::MutexLock lock(&mutex_);
    stopping_ = true;
  }
  for (std::thread& thread : threads_) thread.join();
}

void Scheduler::Add(std::shared_ptr<Job> job) {
  absl::MutexLock lock(&mutex_);
  queue_.push_back(std::move(job));
}

void Scheduler::Work() {
  while (true) {
    std::shared_ptr<Job> job;
    {
      absl::MutexLock lock(&mutex_);
      auto ready = [this]()
                       ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return stopping_ || !queue_.empty(); };
      mutex_.Await(absl::Condition(&ready));
      if (stopping_) return;
      job = std::move(queue_.front());
      queue_.pop_front();
    }
    runner_->Run(*job);
  }
}

}  // namespace lambert::server

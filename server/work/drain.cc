// WorkTable: how work ends when the server stops.
#include "absl/time/time.h"
#include "server/work/refusals.h"
#include "server/work/work_table.h"

namespace lambert::server {

void WorkTable::StopGranting(Calls& calls) {
  shutting_down_ = true;
  for (auto& [name, exchange] : exchanges_) EndHeld(exchange, ShuttingDown(), calls);
  for (const auto& [name, session] : state_.sessions) SetWaiting(state_, name, false);
}

void WorkTable::Drain(Duration grace) {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    StopGranting(calls);
  }
  MakeCalls(calls);
  auto settled = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
    if (merging_ > 0) return false;
    for (const auto& [job, step] : state_.steps) {
      if (!step.leased.empty()) return false;
    }
    return true;
  };
  absl::MutexLock lock(&mutex_);
  mutex_.AwaitWithTimeout(absl::Condition(&settled), absl::FromChrono(grace));
}

void WorkTable::Shutdown() {
  Calls calls;
  {
    absl::MutexLock lock(&mutex_);
    StopGranting(calls);
    for (auto& [job, step] : steps_) step->Abort(ShuttingDown());
  }
  MakeCalls(calls);
  shards_.Shutdown();
}

}  // namespace lambert::server

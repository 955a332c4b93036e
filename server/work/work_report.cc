// WorkTable: what is said of it, to clients and in the log.
#include <utility>

#include "server/work/work_table.h"

namespace lambert::server {

void WorkTable::Note(std::string text, LogSubject about) {
  notes_.emplace_back(std::move(text), std::move(about));
}

std::vector<WorkerInfo> WorkTable::ListWorkers() const {
  absl::MutexLock lock(&mutex_);
  std::vector<WorkerInfo> workers;
  for (const auto& [name, session] : state_.sessions) {
    workers.push_back({session.worker_id, session.slots, static_cast<int>(session.leases.size()),
                       session.finished_units, ToSeconds(clock_() - session.last_seen)});
  }
  return workers;
}

WorkLoad WorkTable::Load() const {
  absl::MutexLock lock(&mutex_);
  return LoadOf(state_);
}

}  // namespace lambert::server

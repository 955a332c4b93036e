#include "server/jobs/job.h"

#include <algorithm>
#include <utility>

#include "server/base/timestamp.h"

namespace lambert::server {

bool IsFinal(v1::SolveJob::State state) {
  return state == v1::SolveJob::STATE_SUCCEEDED || state == v1::SolveJob::STATE_FAILED ||
         state == v1::SolveJob::STATE_CANCELLED;
}

Job::Job(v1::SolveJob record, std::vector<v1::Snapshot> snapshots)
    : name_(record.name()),
      owner_(record.owner()),
      record_(std::move(record)),
      snapshots_(std::move(snapshots)) {}

std::string Job::id() const { return name_.substr(name_.find('/') + 1); }

v1::SolveJob Job::Get() const {
  absl::MutexLock lock(&mutex_);
  return record_;
}

bool Job::ended() const {
  absl::MutexLock lock(&mutex_);
  return IsFinal(record_.state());
}

std::vector<v1::Snapshot> Job::snapshots() const {
  absl::MutexLock lock(&mutex_);
  return snapshots_;
}

void Job::Update(const std::function<void(v1::SolveJob&)>& change) {
  {
    absl::MutexLock lock(&mutex_);
    change(record_);
  }
  Tell();
}

void Job::SetProgress(const v1::Progress& progress) {
  {
    absl::MutexLock lock(&mutex_);
    *record_.mutable_progress() = progress;
    ++progress_count_;
  }
  Tell();
}

void Job::AddSnapshot(const v1::Snapshot& snapshot) {
  {
    absl::MutexLock lock(&mutex_);
    *record_.mutable_latest_snapshot() = snapshot;
    *record_.mutable_progress() = snapshot.progress();
    snapshots_.push_back(snapshot);
  }
  Tell();
}

void Job::RepeatProgress() {
  {
    absl::MutexLock lock(&mutex_);
    if (IsFinal(record_.state())) return;
    ++progress_count_;
  }
  Tell();
}

bool Job::Start() {
  {
    absl::MutexLock lock(&mutex_);
    if (record_.state() != v1::SolveJob::STATE_QUEUED) return false;
    record_.set_state(v1::SolveJob::STATE_RUNNING);
    if (!record_.has_start_time()) *record_.mutable_start_time() = TimestampNow();
  }
  Tell();
  return true;
}

bool Job::CancelQueued() {
  {
    absl::MutexLock lock(&mutex_);
    if (record_.state() != v1::SolveJob::STATE_QUEUED) return false;
    record_.set_state(v1::SolveJob::STATE_CANCELLED);
    *record_.mutable_end_time() = TimestampNow();
  }
  Tell();
  return true;
}

Job::News Job::GetNews() const {
  absl::MutexLock lock(&mutex_);
  return {record_.latest_snapshot(), progress_count_, record_.progress(), IsFinal(record_.state())};
}

void Job::AddListener(std::weak_ptr<JobListener> listener) {
  absl::MutexLock lock(&mutex_);
  listeners_.push_back(std::move(listener));
}

void Job::Tell() {
  std::vector<std::shared_ptr<JobListener>> alive;
  {
    absl::MutexLock lock(&mutex_);
    std::erase_if(listeners_, [](const auto& listener) { return listener.expired(); });
    for (const auto& listener : listeners_) alive.push_back(listener.lock());
  }
  for (const auto& listener : alive) {
    if (listener != nullptr) listener->OnNews();
  }
}

}  // namespace lambert::server

// One job: its record, and the news of it for those who watch.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/synchronization/mutex.h"
#include "lambert/v1/snapshot.pb.h"
#include "lambert/v1/solve_job_service.pb.h"

namespace lambert::server {

// Is told that there is news of a job; must not block.
class JobListener {
 public:
  virtual ~JobListener() = default;
  virtual void OnNews() = 0;
};

// Thread safe. Of all news only the newest is kept: who comes late misses what was between.
class Job {
 public:
  explicit Job(v1::SolveJob record, std::vector<v1::Snapshot> snapshots = {});

  const std::string& name() const { return name_; }  // solveJobs/{id}
  std::string id() const;
  const std::string& owner() const { return owner_; }  // SolveJob.owner

  v1::SolveJob Get() const;
  bool ended() const;
  std::vector<v1::Snapshot> snapshots() const;  // descriptions of all, by version

  // Changes the record and wakes the listeners.
  void Update(const std::function<void(v1::SolveJob&)>& change);
  void SetProgress(const v1::Progress& progress);
  // Adds a snapshot, newer than all before. Requires: its payload is stored.
  void AddSnapshot(const v1::Snapshot& snapshot);
  // Tells the progress again, so that watchers see that the job is alive.
  void RepeatProgress();

  // From queued to running. False where the job was cancelled meanwhile.
  bool Start();
  // From queued to cancelled. False where the job runs or has ended.
  bool CancelQueued();

  // What a watcher needs to know whether there is news for it.
  struct News {
    v1::Snapshot snapshot;       // version 0: none yet
    int64_t progress_count = 0;  // grows with each progress
    v1::Progress progress;
    bool ended = false;
  };
  News GetNews() const;
  // Listeners are told from any thread, for as long as they live.
  void AddListener(std::weak_ptr<JobListener> listener);

 private:
  void Tell();

  const std::string name_, owner_;
  mutable absl::Mutex mutex_;
  v1::SolveJob record_ ABSL_GUARDED_BY(mutex_);
  std::vector<v1::Snapshot> snapshots_ ABSL_GUARDED_BY(mutex_);
  int64_t progress_count_ ABSL_GUARDED_BY(mutex_) = 0;
  std::vector<std::weak_ptr<JobListener>> listeners_ ABSL_GUARDED_BY(mutex_);
};

bool IsFinal(v1::SolveJob::State state);

}  // namespace lambert::server

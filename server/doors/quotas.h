// How much each client may use.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "absl/status/status.h"
#include "absl/synchronization/mutex.h"
#include "server/base/record_store.h"

namespace lambert::server {

// Of each name that a token or certificate gives. Who comes through open doors has no name, and no
// limit but that of watchers. 0: no limit.
struct QuotaOptions {
  int64_t jobs = 20;               // that have not ended
  int64_t stored_bytes = 0;        // of uploads, scenes, patch sets and solutions
  int64_t rays_per_day = 0;        // from midnight to midnight, UTC
  double cpu_seconds_per_day = 0;  // of workers, likewise
  int64_t watchers = 1000;         // streams of snapshots at once
};

// RESOURCE_EXHAUSTED with `reason` and, as metadata, what is limited, the limit and what is used.
absl::Status LimitExceeded(const std::string& reason, const std::string& where,
                           const std::string& what, double limit, double used,
                           const std::string& hint);

// Thread safe. Every check fails with QUOTA_EXCEEDED; BeginWatch with TOO_MANY_WATCHERS.
class Quotas {
 public:
  // `day` counts days; it may only grow.
  Quotas(const QuotaOptions& options, std::function<int64_t()> day, RecordStore* records);

  // Finds what was used today before a restart. RECORD_CORRUPT. Call it before anything else.
  absl::Status Restore();
  // Keeps what was used since the last call; where that fails, the next call tries again. Slow.
  absl::Status Save();

  const QuotaOptions& options() const { return options_; }

  // Before a client who has `used` of them gets `more`.
  absl::Status CheckJobs(const std::string& owner, int64_t used) const;
  absl::Status CheckBytes(const std::string& owner, int64_t used, int64_t more) const;
  // What has been used today.
  absl::Status CheckWork(const std::string& owner);
  // Books rays and seconds of a client's job.
  void Charge(const std::string& owner, int64_t rays, double cpu_seconds);
  // One more stream, until EndWatch where it is OK.
  absl::Status BeginWatch(const std::string& owner);
  void EndWatch(const std::string& owner);

 private:
  struct Work {
    int64_t rays = 0;
    double cpu_seconds = 0;
    bool is_saved = false;
  };
  void BeginDay() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  const QuotaOptions options_;
  const std::function<int64_t()> now_;
  RecordStore* const records_;
  absl::Mutex mutex_;
  int64_t day_ ABSL_GUARDED_BY(mutex_) = 0;
  std::map<std::string, Work> work_ ABSL_GUARDED_BY(mutex_);  // of the day, by owner
  std::map<std::string, int64_t> watchers_ ABSL_GUARDED_BY(mutex_);
};

// Days since 1970, UTC.
int64_t DayNow();

}  // namespace lambert::server

// Final gathers: what arrives at points that a client sends, from a job's newest solution.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "lambert/v1/gather_service.pb.h"
#include "radiosity/shoot/unit.h"
#include "server/base/task_pool.h"
#include "server/run/runner_parts.h"

namespace lambert::server {

// Gathers are kept in memory alone: what one gives is a pure function of its name, so a client that
// finds one gone asks again. Their points and values are uploads of the client's, which count for
// its quota, and go when they are idle. Thread safe.
class Gathers {
 public:
  // All of `parts` outlives the gathers. Two run at a time.
  explicit Gathers(const RunnerParts& parts);
  // Waits for those that run, which the end of the work table ends, and for those that wait.
  ~Gathers();

  // Slow: reads points and solution. Fails as GatherService.CreateGather says.
  absl::StatusOr<v1::Gather> Create(const Identity& who, const v1::CreateGatherRequest& request);
  absl::StatusOr<v1::Gather> Get(const Identity& who, const std::string& name) const;

 private:
  struct Entry;
  absl::StatusOr<std::shared_ptr<Entry>> Prepare(const Identity& who,
                                                 const v1::CreateGatherRequest& request) const;
  // The gather of that name where it runs, or its values are there; else null.
  std::shared_ptr<Entry> FindUsable(const std::string& name) const;
  // Queues the entry; or finds the gather of the same name.
  absl::StatusOr<std::shared_ptr<Entry>> Start(std::shared_ptr<Entry> entry);
  void Run(Entry& entry);
  absl::StatusOr<v1::Digest> Solve(Entry& entry);
  absl::StatusOr<UnitResult> RunUnits(Entry& entry);
  v1::Gather Describe(const Entry& entry) const;

  const RunnerParts parts_;
  mutable absl::Mutex mutex_;
  int running_ ABSL_GUARDED_BY(mutex_) = 0;                                        // and waiting
  std::map<std::string, std::shared_ptr<Entry>> entries_ ABSL_GUARDED_BY(mutex_);  // by name
  std::deque<std::string> ended_ ABSL_GUARDED_BY(mutex_);  // names, the oldest first
  TaskPool pool_;                                          // last: its tasks use all above
};

}  // namespace lambert::server

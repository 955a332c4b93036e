// The merge shards of a coordinator: who is there, and which steps they take sums of.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "server/base/clock.h"
#include "server/work/published_step.h"
#include "server/work/work_state.h"

namespace lambert::server {

struct ShardSync {
  std::string shard, address, unit_version;
  int64_t seen_version = 0;
  bool draining = false;
};

// What a shard takes of a step.
struct ShardOrder {
  std::shared_ptr<const PublishedStep> step;
  PatchIndex first = 0, end = 0;
};

struct ShardOrders {
  int64_t version = 0;
  std::vector<ShardOrder> orders;
};

// Called exactly once, from any thread, without the table's lock.
using ShardSyncDone = std::function<void(absl::StatusOr<ShardOrders>)>;

// Thread safe.
class ShardTable {
 public:
  // `epoch` as WorkTable's. Takes the sync interval, the expiry and the least range of `options`.
  ShardTable(const WorkOptions& options, std::string unit_version, int64_t epoch, Clock clock);

  // Holds `done` until there is news, or the sync interval has passed. FIELD_INVALID,
  // UNIT_VERSION_UNSUPPORTED, SHUTTING_DOWN; SYNC_REPLACED. `call` identifies it for CancelSync.
  // A shard that has the address of another takes its place.
  void Sync(const ShardSync& request, const void* call, ShardSyncDone done);
  void CancelSync(const std::string& shard, const void* call);

  // Patches cut into ranges of equal length, one a shard that is there and does not leave; fewer,
  // or none, where ranges would be shorter than `least_shard_patches`.
  std::vector<ShardRange> Divide(PatchIndex patch_count) const;
  // Tells the shards of a step that they take its parts. Aborts it where one is there no more.
  void Add(const std::shared_ptr<PublishedStep>& step);
  // The step is over: nothing is done for it any more.
  void Remove(const std::shared_ptr<PublishedStep>& step);
  // Takes the sum of a shard. False where the step is over. Fails as PublishedStep::TakeRange.
  absl::StatusOr<bool> TakeRange(const std::string& shard, int64_t step_number,
                                 const std::string& bytes);
  // Most bytes that a sum of this step may have; 0 where it is over.
  int64_t MaxRangeBytes(int64_t step_number) const;

  // Loses silent shards, gives up sums that do not come, and answers calls held long enough. Call
  // it often.
  void Tick();
  void Shutdown();

  int shard_count() const;

 private:
  struct Shard {
    std::string address;
    bool draining = false;
    TimePoint last_seen, answer_by;
    int64_t seen_version = 0;
    ShardSyncDone held;  // null: none
    const void* held_call = nullptr;
  };
  using Calls = std::vector<std::function<void()>>;  // to be made without the lock

  static void MakeCalls(Calls& calls) {
    for (auto& call : calls) call();
  }
  absl::Status Check(const ShardSync& request) const ABSL_SHARED_LOCKS_REQUIRED(mutex_);
  void Lose(const std::string& shard, const std::string& why, Calls& calls)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void EndHeld(Shard& shard, absl::StatusOr<ShardOrders> reply, Calls& calls)
      ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  // Answers who knows another version than this, or has waited long enough.
  void AnswerHeld(Calls& calls) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  void Note(const std::string& line, Calls& calls) const;
  // Aborts steps whose sums take too long: a worker said that it had sent all parts, and had not.
  void GiveUpLate() ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);
  ShardOrders OrdersOf(const std::string& shard) const ABSL_SHARED_LOCKS_REQUIRED(mutex_);

  const WorkOptions options_;
  const std::string unit_version_;
  const Clock clock_;
  mutable absl::Mutex mutex_;
  int64_t version_ ABSL_GUARDED_BY(mutex_);
  bool shutting_down_ ABSL_GUARDED_BY(mutex_) = false;
  std::map<std::string, Shard> shards_ ABSL_GUARDED_BY(mutex_);  // by name
  struct Awaited {
    std::shared_ptr<PublishedStep> step;
    TimePoint waits_since = TimePoint::max();  // for nothing but sums of shards
  };
  std::map<int64_t, Awaited> steps_ ABSL_GUARDED_BY(mutex_);  // by number
};

}  // namespace lambert::server

// A step while workers run its units: what they are, and what came back so far.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "radiosity/shoot/unit.h"
#include "server/work/grain_runs.h"

namespace lambert::server {

// What all units of a job have in common.
struct WorkSetup {
  std::string job;  // id
  std::string patch_set_sha256;
  int64_t patch_set_bytes = 0;
  PatchIndex patch_count = 0;
  std::string shoot_options;   // EncodeShootOptions
  bool has_sightings = false;  // results may tell what every ray has seen
  // What a gather gathers (gather_units.h); "": units of shooting. `patch_count` then counts the
  // numbers of the result.
  std::string gather_task_sha256 = {};
  int64_t gather_task_bytes = 0;
};

// Patches whose sums a merge shard takes.
struct ShardRange {
  std::string shard;    // its name
  std::string address;  // HOST:PORT
  PatchIndex first = 0, end = 0;
};

// Thread safe.
class PublishedStep {
 public:
  // `shards`: who adds up the results, in the order of their ranges, which cover all patches once;
  // none: this step itself.
  PublishedStep(WorkSetup setup, int64_t number, std::vector<WorkUnit> grains,
                std::vector<ShardRange> shards = {});

  const WorkSetup& setup() const { return setup_; }
  int64_t number() const { return number_; }
  // Of all units together.
  int64_t rays() const { return rays_; }
  const std::vector<ShardRange>& shards() const { return shards_; }

  // Some grains as one unit: its result is the sum of theirs. Requires: one range or more, and they
  // are there.
  WorkUnit Unit(const std::vector<GrainRange>& grains) const;
  // Decodes a result of these grains, or its ledger alone where shards take the rest, and checks
  // the ledger. INVALID_ARGUMENT (RESULT_INVALID), naming `worker`. Requires: they are there.
  absl::StatusOr<UnitResult> Check(const std::vector<GrainRange>& grains, const std::string& worker,
                                   const std::string& bytes) const;
  // Adds a checked result of these grains. Requires: each grain once.
  void Merge(const UnitResult& result, const std::vector<GrainRange>& grains);
  // Of the grains, how many are merged.
  double done_fraction() const;
  // Takes the sum of a shard; of two that one shard sends the first counts. INVALID_ARGUMENT
  // (RESULT_INVALID), which also ends the step: it has to begin anew. NOT_FOUND for other shards.
  absl::Status TakeRange(const std::string& shard, const std::string& bytes);
  // True where results are all there and sums of shards are missing.
  bool WaitsForShards() const;
  // True where the sum of this shard is missing.
  bool WaitsFor(const std::string& shard) const;
  // Ends the step without a result. The first of Abort and the last Merge or TakeRange counts.
  void Abort(const absl::Status& status);
  // Blocks until every grain is merged and every range is there, or the step aborted.
  // SHARD_FAILED where a shard was lost, or the ranges do not fit the ledgers: to be shot again.
  absl::StatusOr<UnitResult> Wait();

  static absl::Status ShardFailed(const std::string& shard, const std::string& why);

 private:
  bool IsWhole() const ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
    return merged_grains_ == grains_.size() && ranges_.size() == shards_.size();
  }
  const WorkSetup setup_;
  const int64_t number_;
  const std::vector<WorkUnit> grains_;
  const std::vector<ShardRange> shards_;
  int64_t rays_ = 0;  // set once
  mutable absl::Mutex mutex_;
  std::map<PatchIndex, UnitResult> ranges_ ABSL_GUARDED_BY(mutex_);  // that came, by first patch
  UnitResult merged_ ABSL_GUARDED_BY(mutex_);
  size_t merged_grains_ ABSL_GUARDED_BY(mutex_) = 0;
  absl::Status status_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace lambert::server

// The sums that a merge shard makes: for each step the parts of all units, each once.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "radiosity/shoot/unit.h"
#include "server/merge/merge_counters.h"

namespace lambert::server {

// What the coordinator asks for.
struct MergeStep {
  std::string job;  // "solveJobs/ID"
  int64_t number = 0;
  int64_t rays = 0;  // of all units together
  PatchIndex patch_count = 0, first = 0, end = 0;
  bool has_sightings = false;
};

struct PartUnit {
  int unit = 0;
  int64_t rays = 0;
};

// What the results of some units tell of the shard's patches, added up.
struct Part {
  int64_t step_number = 0;
  std::vector<PartUnit> units;
  std::string bytes;  // EncodeUnitResult
};

// The sum of a step that is whole.
struct MergedRange {
  MergeStep step;
  std::string bytes;  // EncodeUnitResult
};

enum class PartOutcome { kAccepted, kDuplicate, kSplit };

// A unit is a pure function, so that whoever computes it sends the same part: the first one counts.
// Nothing is lost with a worker that sent its part to some shards only; who computes the unit again
// fills in what is missing. Thread safe; parts are decoded and added without the shard's lock.
class MergeShard {
 public:
  // Takes these steps from now on, and forgets all others.
  void SetSteps(const std::vector<MergeStep>& steps);
  // Most bytes that a part of this step may have. UNAVAILABLE (STEP_UNKNOWN): it is over, or begins
  // in a moment.
  absl::StatusOr<int64_t> MaxPartBytes(int64_t step_number) const;
  // RESULT_INVALID, and STEP_UNKNOWN as above.
  absl::StatusOr<PartOutcome> Submit(const Part& part);
  MergeCounters& counters() { return counters_; }

  // Blocks until a step is whole and takes its sum; each is returned once. Nothing once closed.
  std::optional<MergedRange> TakeWhole();
  // True while the step is taken.
  bool Takes(int64_t step_number) const;
  int step_count() const;
  // Open: TakeWhole blocks. The steps are forgotten.
  void Open();
  void Close();

 private:
  struct Sums {
    explicit Sums(MergeStep taken) : step(std::move(taken)) {}
    const MergeStep step;
    absl::Mutex mutex;
    std::set<int> units ABSL_GUARDED_BY(mutex);  // whose parts are added
    int64_t rays ABSL_GUARDED_BY(mutex) = 0;     // of those
    UnitResult sum ABSL_GUARDED_BY(mutex);
  };
  absl::StatusOr<std::shared_ptr<Sums>> Find(int64_t step_number) const;
  absl::StatusOr<PartOutcome> Add(const Part& part);

  MergeCounters counters_;
  mutable absl::Mutex mutex_;
  std::map<int64_t, std::shared_ptr<Sums>> steps_ ABSL_GUARDED_BY(mutex_);
  std::deque<std::shared_ptr<Sums>> whole_ ABSL_GUARDED_BY(mutex_);
  bool closed_ ABSL_GUARDED_BY(mutex_) = false;
};

}  // namespace lambert::server

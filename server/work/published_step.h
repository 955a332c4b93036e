// A step while workers run its units: what they are, and what came back so far.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "radiosity/shoot/unit.h"

namespace lambert::server {

// What all units of a job have in common.
struct WorkSetup {
  std::string job;                // id
  std::string patch_set_sha256;
  int64_t patch_set_bytes = 0;
  PatchIndex patch_count = 0;
  std::string shoot_options;      // EncodeShootOptions
};

// Thread safe.
class PublishedStep {
 public:
  PublishedStep(WorkSetup setup, int64_t number, std::vector<WorkUnit> units);

  const WorkSetup& setup() const { return setup_; }
  int64_t number() const { return number_; }
  const std::vector<WorkUnit>& units() const { return units_; }

  // Decodes a result of a unit and checks its ledger. INVALID_ARGUMENT (RESULT_INVALID), naming
  // `worker`. Requires: 0 <= unit < units().size().
  absl::StatusOr<UnitResult> Check(int unit, const std::string& worker,
                                   const std::string& bytes) const;
  // Adds a checked result. Requires: once a unit.
  void Merge(const UnitResult& result);
  // Ends the step without a result. The first of Abort and the last Merge counts.
  void Abort(const absl::Status& status);
  // Blocks until every unit is merged, or the step aborted.
  absl::StatusOr<UnitResult> Wait();

 private:
  const WorkSetup setup_;
  const int64_t number_;
  const std::vector<WorkUnit> units_;
  absl::Mutex mutex_;
  UnitResult merged_ ABSL_GUARDED_BY(mutex_);
  size_t merged_units_ ABSL_GUARDED_BY(mutex_) = 0;
  absl::Status status_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace lambert::server

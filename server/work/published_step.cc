#include "server/work/published_step.h"

#include <utility>

#include "radiosity/core/error.h"

namespace lambert::server {

PublishedStep::PublishedStep(WorkSetup setup, int64_t number, std::vector<WorkUnit> units)
    : setup_(std::move(setup)), number_(number), units_(std::move(units)) {}

absl::StatusOr<UnitResult> PublishedStep::Check(int unit, const std::string& worker,
                                                const std::string& bytes) const {
  absl::StatusOr<UnitResult> result = DecodeUnitResult(bytes, setup_.patch_count);
  absl::Status status = result.ok() ? CheckLedger(units_[unit], *result) : result.status();
  if (status.ok()) return result;
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"RESULT_INVALID",
                    "worker " + worker + ", unit " + std::to_string(unit) + " of " + setup_.job,
                    std::string(status.message()), "check that machine's memory and programs"});
}

void PublishedStep::Merge(const UnitResult& result) {
  absl::MutexLock lock(&mutex_);
  MergeResult(result, merged_);
  ++merged_units_;
}

void PublishedStep::Abort(const absl::Status& status) {
  absl::MutexLock lock(&mutex_);
  if (status_.ok() && merged_units_ < units_.size()) status_ = status;
}

absl::StatusOr<UnitResult> PublishedStep::Wait() {
  absl::MutexLock lock(&mutex_);
  auto ended = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
    return !status_.ok() || merged_units_ == units_.size();
  };
  mutex_.Await(absl::Condition(&ended));
  if (!status_.ok()) return status_;
  return std::move(merged_);
}

}  // namespace lambert::server

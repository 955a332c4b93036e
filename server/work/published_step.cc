#include "server/work/published_step.h"

#include <utility>

#include "radiosity/core/error.h"

namespace lambert::server {

PublishedStep::PublishedStep(WorkSetup setup, int64_t number, std::vector<WorkUnit> grains)
    : setup_(std::move(setup)), number_(number), grains_(std::move(grains)) {
  for (const WorkUnit& grain : grains_) rays_ += grain.RayCount();
}

WorkUnit PublishedStep::Unit(const std::vector<GrainRange>& grains) const {
  WorkUnit unit = grains_[grains.front().first];
  unit.visits.clear();
  for (const GrainRange& range : grains) {
    for (int i = range.first; i < range.first + range.count; ++i) {
      unit.visits.insert(unit.visits.end(), grains_[i].visits.begin(), grains_[i].visits.end());
    }
  }
  return unit;
}

absl::StatusOr<UnitResult> PublishedStep::Check(const std::vector<GrainRange>& grains,
                                                const std::string& worker,
                                                const std::string& bytes) const {
  absl::StatusOr<UnitResult> result = DecodeUnitResult(bytes, setup_.patch_count);
  absl::Status status = result.ok() ? CheckLedger(Unit(grains), *result) : result.status();
  if (status.ok()) return result;
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"RESULT_INVALID", "worker " + worker + ", a unit of " + setup_.job,
                    std::string(status.message()), "check that machine's memory and programs"});
}

void PublishedStep::Merge(const UnitResult& result, const std::vector<GrainRange>& grains) {
  absl::MutexLock lock(&mutex_);
  MergeResult(result, merged_);
  for (const GrainRange& range : grains) merged_grains_ += static_cast<size_t>(range.count);
}

double PublishedStep::done_fraction() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<double>(merged_grains_) / static_cast<double>(grains_.size());
}

void PublishedStep::Abort(const absl::Status& status) {
  absl::MutexLock lock(&mutex_);
  if (status_.ok() && merged_grains_ < grains_.size()) status_ = status;
}

absl::StatusOr<UnitResult> PublishedStep::Wait() {
  absl::MutexLock lock(&mutex_);
  auto ended = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
    return !status_.ok() || merged_grains_ == grains_.size();
  };
  mutex_.Await(absl::Condition(&ended));
  if (!status_.ok()) return status_;
  return std::move(merged_);
}

}  // namespace lambert::server

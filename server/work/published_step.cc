#include "server/work/published_step.h"

#include <utility>

#include <algorithm>

#include "radiosity/core/error.h"
#include "radiosity/shoot/result_range.h"

namespace lambert::server {
namespace {

// What of a result comes here while shards take the rest.
absl::Status CheckLedgerLine(const WorkUnit& unit, const UnitResult& line) {
  bool is_sound = line.deposits.empty() && line.rests.empty() && line.sightings.empty() &&
                  unit.MayHaveShot(unit.RayCount(), line.rays) && line.channels == unit.channels;
  for (int c = 0; c < 3; ++c) {
    is_sound = is_sound && line.escaped[c] >= 0 && line.escaped[c] <= line.shot[c];
  }
  return is_sound ? absl::OkStatus() : absl::DataLossError("its ledger does not balance");
}

}  // namespace

PublishedStep::PublishedStep(WorkSetup setup, int64_t number, std::vector<WorkUnit> grains,
                             std::vector<ShardRange> shards)
    : setup_(std::move(setup)),
      number_(number),
      grains_(std::move(grains)),
      shards_(std::move(shards)) {
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
  absl::Status status = result.status();
  if (status.ok()) {
    const WorkUnit unit = Unit(grains);
    status = shards_.empty() ? CheckLedger(unit, *result) : CheckLedgerLine(unit, *result);
  }
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

absl::Status PublishedStep::ShardFailed(const std::string& shard, const std::string& why) {
  return MakeError(absl::StatusCode::kUnavailable,
                   {"SHARD_FAILED", "merge shard " + shard, why, "the step is shot again"});
}

absl::Status PublishedStep::TakeRange(const std::string& shard, const std::string& bytes) {
  const auto found =
      std::find_if(shards_.begin(), shards_.end(),
                   [&shard](const ShardRange& range) { return range.shard == shard; });
  if (found == shards_.end()) return absl::NotFoundError("no shard of the step");
  absl::StatusOr<UnitResult> range = DecodeUnitResult(bytes, setup_.patch_count);
  if (!range.ok() || !IsRange(*range, found->first, found->end)) {
    Abort(ShardFailed(shard, "its sum is none of its range"));
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"RESULT_INVALID", "merge shard " + shard, "the sum is none of its range",
                      "check that machine's memory and programs"});
  }
  absl::MutexLock lock(&mutex_);
  ranges_.emplace(found->first, *std::move(range));
  return absl::OkStatus();
}

bool PublishedStep::WaitsForShards() const {
  absl::MutexLock lock(&mutex_);
  return merged_grains_ == grains_.size() && !IsWhole();
}

bool PublishedStep::WaitsFor(const std::string& shard) const {
  absl::MutexLock lock(&mutex_);
  return std::any_of(shards_.begin(), shards_.end(),
                     [&](const ShardRange& range) ABSL_SHARED_LOCKS_REQUIRED(mutex_) {
                       return range.shard == shard && ranges_.count(range.first) == 0;
                     });
}

void PublishedStep::Abort(const absl::Status& status) {
  absl::MutexLock lock(&mutex_);
  if (status_.ok() && !IsWhole()) status_ = status;
}

absl::StatusOr<UnitResult> PublishedStep::Wait() {
  absl::MutexLock lock(&mutex_);
  auto ended = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return !status_.ok() || IsWhole(); };
  mutex_.Await(absl::Condition(&ended));
  if (!status_.ok()) return status_;
  if (shards_.empty()) return std::move(merged_);
  for (const auto& [first, range] : ranges_) AppendRange(range, merged_);
  const absl::Status sound = CheckLedger(grains_.front(), rays_, merged_);
  if (!sound.ok()) return ShardFailed("sums", std::string(sound.message()));
  return std::move(merged_);
}

}  // namespace lambert::server

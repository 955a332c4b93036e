#include "server/merge/merge_shard.h"

#include <utility>

#include "radiosity/core/error.h"
#include "radiosity/shoot/result_range.h"
#include "server/base/clock.h"
#include "server/work/result_bytes.h"

namespace lambert::server {
namespace {

absl::Status Invalid(const std::string& what) {
  return MakeError(
      absl::StatusCode::kInvalidArgument,
      {"RESULT_INVALID", "part of a result", what, "check that machine's memory and programs"});
}

// The rays of units that a step may have, each named once; 0 where they are none.
int64_t RaysOf(const std::vector<PartUnit>& units, int64_t most) {
  std::set<int> met;
  int64_t rays = 0;
  for (const PartUnit& unit : units) {
    if (unit.unit < 0 || unit.rays < 1 || unit.rays > most - rays ||
        !met.insert(unit.unit).second) {
      return 0;
    }
    rays += unit.rays;
  }
  return rays;
}

}  // namespace

void MergeShard::SetSteps(const std::vector<MergeStep>& steps) {
  std::map<int64_t, std::shared_ptr<Sums>> kept;
  absl::MutexLock lock(&mutex_);
  for (const MergeStep& step : steps) {
    auto found = steps_.find(step.number);
    kept[step.number] = found != steps_.end() ? found->second : std::make_shared<Sums>(step);
  }
  steps_ = std::move(kept);
}

absl::StatusOr<std::shared_ptr<MergeShard::Sums>> MergeShard::Find(int64_t step_number) const {
  absl::MutexLock lock(&mutex_);
  auto found = steps_.find(step_number);
  if (found != steps_.end()) return found->second;
  return MakeError(
      absl::StatusCode::kUnavailable,
      {"STEP_UNKNOWN", "step " + std::to_string(step_number),
       "it is over, or the server has not told of it yet", "send it again in a moment"});
}

absl::StatusOr<int64_t> MergeShard::MaxPartBytes(int64_t step_number) const {
  const absl::StatusOr<std::shared_ptr<Sums>> sums = Find(step_number);
  if (!sums.ok()) return sums.status();
  const MergeStep& step = (*sums)->step;
  return MaxResultBytes(step.end - step.first, step.rays, step.has_sightings);
}

absl::StatusOr<PartOutcome> MergeShard::Submit(const Part& part) {
  const TimePoint began = SteadyNow();
  const absl::StatusOr<PartOutcome> outcome = Add(part);
  counters_.part_bytes += static_cast<int64_t>(part.bytes.size());
  counters_.merge_microseconds +=
      std::chrono::duration_cast<std::chrono::microseconds>(SteadyNow() - began).count();
  if (!outcome.ok()) {
    ++counters_.parts_refused;
  } else if (*outcome == PartOutcome::kAccepted) {
    ++counters_.parts_accepted;
  } else if (*outcome == PartOutcome::kDuplicate) {
    ++counters_.parts_duplicate;
  } else {
    ++counters_.parts_split;
  }
  return outcome;
}

absl::StatusOr<PartOutcome> MergeShard::Add(const Part& part) {
  const absl::StatusOr<std::shared_ptr<Sums>> found = Find(part.step_number);
  if (!found.ok()) return found.status();
  Sums& sums = **found;
  const int64_t rays = RaysOf(part.units, sums.step.rays);
  if (rays == 0) return Invalid("its units are none of the step");
  absl::StatusOr<UnitResult> range = DecodeUnitResult(part.bytes, sums.step.patch_count);
  if (!range.ok() || !IsRange(*range, sums.step.first, sums.step.end)) {
    return Invalid("it is no part of this shard's patches");
  }
  bool is_whole = false;
  {
    absl::MutexLock lock(&sums.mutex);
    size_t known = 0;
    for (const PartUnit& unit : part.units) known += sums.units.count(unit.unit);
    if (known == part.units.size()) return PartOutcome::kDuplicate;
    if (known > 0) return PartOutcome::kSplit;
    if (rays > sums.step.rays - sums.rays) return Invalid("its step has fewer rays");
    for (const PartUnit& unit : part.units) sums.units.insert(unit.unit);
    MergeResult(*range, sums.sum);
    sums.sum.channels = range->channels;
    sums.rays += rays;
    is_whole = sums.rays == sums.step.rays;
  }
  if (is_whole) {
    ++counters_.sums;
    absl::MutexLock lock(&mutex_);
    whole_.push_back(*found);
  }
  return PartOutcome::kAccepted;
}

std::optional<MergedRange> MergeShard::TakeWhole() {
  std::shared_ptr<Sums> sums;
  {
    absl::MutexLock lock(&mutex_);
    auto ready = [this]() ABSL_SHARED_LOCKS_REQUIRED(mutex_) { return closed_ || !whole_.empty(); };
    mutex_.Await(absl::Condition(&ready));
    if (closed_) return std::nullopt;
    sums = std::move(whole_.front());
    whole_.pop_front();
  }
  absl::MutexLock lock(&sums->mutex);
  const UnitResult sum = std::move(sums->sum);
  return MergedRange{sums->step, EncodeUnitResult(sum)};
}

bool MergeShard::Takes(int64_t step_number) const {
  absl::MutexLock lock(&mutex_);
  return steps_.count(step_number) > 0;
}

int MergeShard::step_count() const {
  absl::MutexLock lock(&mutex_);
  return static_cast<int>(steps_.size());
}

void MergeShard::Open() {
  absl::MutexLock lock(&mutex_);
  closed_ = false;
  steps_.clear();
  whole_.clear();
}

void MergeShard::Close() {
  absl::MutexLock lock(&mutex_);
  closed_ = true;
}

}  // namespace lambert::server

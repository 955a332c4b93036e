#include "server/run/journal_executor.h"

#include <algorithm>
#include <optional>

namespace lambert::server {
namespace {

// A step is journalled where it took this many times longer than journalling takes: so journals
// take a twentieth of the time at most, and a step that is lost with the process took little.
constexpr double kWorthFactor = 20;
// Below that, waiting for the disk is all there is (docs/benchmarks.md).
constexpr size_t kLeastBytes = 1 << 18;
// Of the expected cost that is left after a step that was not journalled.
constexpr double kForget = 0.99;

size_t SizeOf(const UnitResult& result) {
  return std::max(kLeastBytes, (result.deposits.size() + result.rests.size()) * sizeof(Deposit) +
                                   result.sightings.size() * sizeof(Sighting));
}

}  // namespace

double JournalCost::Expect(size_t result_bytes) const {
  return seconds_per_byte_ * static_cast<double>(std::max(kLeastBytes, result_bytes));
}

void JournalCost::Learn(size_t result_bytes, double seconds) {
  const double measured = seconds / static_cast<double>(std::max(kLeastBytes, result_bytes));
  seconds_per_byte_ = seconds_per_byte_ > 0 ? (seconds_per_byte_ + measured) / 2 : measured;
}

void JournalCost::Forget() { seconds_per_byte_ *= kForget; }

JournalExecutor::JournalExecutor(StepExecutor* inner, Journal* journal, JournalMode mode,
                                 PatchIndex patch_count, Clock clock,
                                 std::function<void(const std::string&)> log)
    : inner_(inner),
      journal_(journal),
      mode_(mode),
      patch_count_(patch_count),
      clock_(std::move(clock)),
      log_(std::move(log)) {}

absl::StatusOr<UnitResult> JournalExecutor::RunStep(const std::vector<WorkUnit>& units) {
  if (units.empty() || !journal_->keeps()) return inner_->RunStep(units);
  if (std::optional<UnitResult> kept = journal_->Find(units, patch_count_); kept.has_value()) {
    ++replayed_;
    return *std::move(kept);
  }
  TellResumed(units.front());
  ++shot_;
  const TimePoint began = clock_();
  absl::StatusOr<UnitResult> result = inner_->RunStep(units);
  if (!result.ok()) return result.status();
  if (absl::Status kept = Keep(units, *result, ToSeconds(clock_() - began)); !kept.ok()) {
    return kept;
  }
  return result;
}

std::string JournalExecutor::Summary() const {
  if (!journal_->keeps()) return "";
  return "kept " + std::to_string(kept_) + " of " + std::to_string(shot_) + " steps in " +
         std::to_string(keeping_seconds_) + " s";
}

void JournalExecutor::TellResumed(const WorkUnit& unit) {
  if (told_ || !journal_->IsPast(unit)) return;
  told_ = true;
  if (!journal_->is_resumed()) return;
  log_("goes on at pass " + std::to_string(unit.pass) + ", step " + std::to_string(unit.step) +
       ", after " + std::to_string(replayed_) + " steps from the journal");
}

absl::Status JournalExecutor::Keep(const std::vector<WorkUnit>& units, const UnitResult& result,
                                   double shot_seconds) {
  if (mode_ == JournalMode::kOff) return absl::OkStatus();
  const size_t bytes = SizeOf(result);
  if (mode_ == JournalMode::kAuto && shot_seconds < kWorthFactor * cost_.Expect(bytes)) {
    cost_.Forget();
    return absl::OkStatus();
  }
  const TimePoint began = clock_();
  const absl::Status kept = journal_->Add(units, result);
  const double seconds = ToSeconds(clock_() - began);
  cost_.Learn(bytes, seconds);
  keeping_seconds_ += seconds;
  kept_ += kept.ok() ? 1 : 0;
  if (kept.ok() || IsOwnershipLost(kept)) return kept;
  log_("a step is not journalled: " + std::string(kept.message()));
  return absl::OkStatus();
}

}  // namespace lambert::server

#include "server/run/table_executor.h"

#include <memory>
#include <string>

#include "radiosity/core/error.h"

namespace lambert::server {
namespace {

// Failures of merge shards that a step bears before it does without them.
constexpr int kMostShardFailures = 3;

}  // namespace

absl::StatusOr<UnitResult> TableExecutor::RunStep(const std::vector<WorkUnit>& units) {
  if (units.empty()) return UnitResult{};
  for (int failures = 0;; ++failures) {
    absl::StatusOr<std::shared_ptr<PublishedStep>> step =
        work_->Publish(setup_, units, /*may_shard=*/failures < kMostShardFailures);
    if (!step.ok()) return step.status();
    absl::StatusOr<UnitResult> result = (*step)->Wait();
    work_->Withdraw(setup_.job);
    if (ReasonOf(result.status()) != "SHARD_FAILED") return result;
    work_->options().log({std::string(result.status().message()),
                          {.job = "solveJobs/" + setup_.job, .step = (*step)->number()}});
  }
}

}  // namespace lambert::server

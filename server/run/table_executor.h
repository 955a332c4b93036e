// Runs the steps of a job on whoever works for this coordinator.
#pragma once

#include <utility>
#include <vector>

#include "radiosity/solve/solver.h"
#include "server/work/work_table.h"

namespace lambert::server {

// A step whose merge shard fails is shot again; often enough, and the coordinator merges by itself,
// where each result is checked before it counts.
class TableExecutor : public StepExecutor {
 public:
  TableExecutor(WorkTable* work, WorkSetup setup) : work_(work), setup_(std::move(setup)) {}
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override;

 private:
  WorkTable* const work_;
  const WorkSetup setup_;
};

}  // namespace lambert::server

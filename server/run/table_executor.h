// Runs the steps of a job on whoever works for this coordinator.
#pragma once

#include <utility>
#include <vector>

#include "radiosity/solve/solver.h"
#include "server/work/work_table.h"

namespace lambert::server {

class TableExecutor : public StepExecutor {
 public:
  TableExecutor(WorkTable* work, WorkSetup setup) : work_(work), setup_(std::move(setup)) {}
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override {
    return work_->RunStep(setup_, units);
  }

 private:
  WorkTable* const work_;
  const WorkSetup setup_;
};

}  // namespace lambert::server

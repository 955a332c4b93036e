// Runs the steps of a job on whoever works for this coordinator.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "radiosity/solve/solver.h"
#include "server/work/work_table.h"

namespace lambert::server {

class TableExecutor : public StepExecutor {
 public:
  TableExecutor(WorkTable* work, WorkSetup setup) : work_(work), setup_(std::move(setup)) {}
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override {
    if (units.empty()) return UnitResult{};
    absl::StatusOr<std::shared_ptr<PublishedStep>> step = work_->Publish(setup_, units);
    if (!step.ok()) return step.status();
    absl::StatusOr<UnitResult> result = (*step)->Wait();
    work_->Withdraw(setup_.job);
    return result;
  }

 private:
  WorkTable* const work_;
  const WorkSetup setup_;
};

}  // namespace lambert::server

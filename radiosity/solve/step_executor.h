// Where the units of a step run.
#pragma once

#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/shoot/shooter.h"
#include "radiosity/shoot/unit.h"

namespace lambert {

// Runs the units of a step somewhere: in this thread, on threads, on other machines.
class StepExecutor {
 public:
  virtual ~StepExecutor() = default;
  // Returns the merged result of all units, whose ledgers were checked. Blocks. CANCELLED: stop and
  // keep what is finished. Any other error ends the run.
  virtual absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) = 0;
};

// All units one after the other in the calling thread.
class SerialExecutor : public StepExecutor {
 public:
  explicit SerialExecutor(std::shared_ptr<const Shooter> shooter) : shooter_(std::move(shooter)) {}
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override;

 private:
  std::shared_ptr<const Shooter> shooter_;
};

}  // namespace lambert

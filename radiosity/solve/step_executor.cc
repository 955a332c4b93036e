#include "radiosity/solve/step_executor.h"

namespace lambert {

absl::StatusOr<UnitResult> SerialExecutor::RunStep(const std::vector<WorkUnit>& units) {
  UnitResult merged;
  for (const WorkUnit& unit : units) {
    absl::StatusOr<UnitResult> result = shooter_->Run(unit);
    if (!result.ok()) return result.status();
    if (absl::Status status = CheckLedger(unit, *result); !status.ok()) return status;
    MergeResult(*result, merged);
  }
  return merged;
}

}  // namespace lambert

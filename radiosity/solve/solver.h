// The loop: passes of steps, merged into an averaged solution with its standard error.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "radiosity/solve/options.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/step_executor.h"

namespace lambert {

enum class StopReason : uint8_t {
  kNone = 0,  // another pass is wanted
  kErrorReached = 1,
  kRaysSpent = 2,
  kTimeSpent = 3,
  kNothingToShoot = 4,  // no emitter: the solution is zero, exactly
};
// "none", "error_reached", "rays_spent", "time_spent", "nothing_to_shoot".
const char* StopReasonName(StopReason reason);

// One thread at a time. Wall-clock time comes from `seconds_now` (monotonic seconds).
class Solver {
 public:
  // Requires: options from MakePlan (method resolved).
  Solver(std::shared_ptr<const PatchSet> patches, const SolveOptions& options,
         std::function<double()> seconds_now);
  ~Solver();

  StopReason stop_reason() const;
  // True where a wanted error was given and is reached, or none was given and the budget is spent.
  bool reached_goal() const;

  // One more pass; `on_step` is called after every step. OK also when the time budget ends the pass
  // early. CANCELLED from the executor is passed on; the snapshot then keeps finished passes (or
  // the partial first one).
  absl::Status RunPass(StepExecutor& executor, const std::function<void(const Progress&)>& on_step);

  // After 0 passes: emission only, unsent fraction 1.
  Snapshot MakeSnapshot() const;

  // State after the last finished pass, for a coordinator that starts again. A solver with the same
  // patches and options continues from it to the same bytes.
  std::string EncodeCheckpoint() const;
  absl::Status Restore(const std::string& checkpoint);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lambert

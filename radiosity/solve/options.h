// What a solution is wanted for, and when it is good enough.
#pragma once

#include <cstdint>

#include "absl/status/status.h"
#include "radiosity/shoot/options.h"

namespace lambert {

struct SolveOptions {
  ShootOptions shoot;  // method kAuto allowed here
  uint64_t seed = 1;
  double max_error = 0;            // wanted estimated relative area-weighted RMS; 0: none wanted
  int64_t max_rays = 0;            // budget; 0: none
  double max_time_s = 0;           // budget of wall-clock seconds; 0: none
  double unsent_tolerance = 1e-9;  // a pass ends when unsent / emitted flux is under this
  int64_t max_steps = 1'000'000;   // of one pass; more: the job fails with STEPS_EXHAUSTED
  // With neither an error nor a budget, solving ends at `kDefaultMaxError`.
  absl::Status Validate() const;
};

inline constexpr double kDefaultMaxError = 0.03;

}  // namespace lambert

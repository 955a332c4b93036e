// What is known of a scene's light at one moment.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/rgb.h"

namespace lambert {

// Balance of the flux of the averaged solution [lm]:
// emitted = absorbed + escaped + unsent + residual.
struct Ledger {
  Rgb emitted, absorbed, escaped, unsent;
  Rgb residual;  // rounding and roulette: mean zero
};

// A standard error that is not known: no replicates were made (Part::kStdError).
inline constexpr Rgb kUnknownError{-1, -1, -1};

struct Solution {
  std::vector<Rgb> radiosity_lm_per_m2;  // all that leaves, emitted and reflected
  std::vector<Rgb> irradiance_lx;        // all that arrives
  std::vector<Rgb> std_error_lm_per_m2;  // of the radiosity, from replicates, or kUnknownError
  std::vector<int64_t> hits;             // rays that arrived, over all passes
  Ledger ledger;
};

// Where a run stands. Cheap; sent often.
struct Progress {
  int32_t pass = 0, step = 0;       // of the last finished step
  int64_t rays = 0;                 // shot so far, all passes
  double seconds = 0;               // wall clock since the run began
  double cpu_seconds = 0;           // of all workers, shooting
  double unsent_fraction = 1;       // of the running pass: unsent / emitted
  double estimated_rms_area = -1;   // CONTRACT's rms_area, estimated; -1: not known yet
  double estimated_rms_patch = -1;  // CONTRACT's rms_patch, estimated; -1: not known yet
  double wanted_rms_area = 0;       // 0: none
  int64_t max_rays = 0;             // 0: none
  int32_t pilot = 0;          // of adaptive meshing, 1, 2, ...: all above is of that pilot; 0: none
  int64_t pilot_patches = 0;  // that the pilot solves
};

// The averaged solution after a pass.
struct Snapshot {
  int64_t version = 0;  // 1, 2, ... within a job
  Progress progress;
  std::shared_ptr<const Solution> solution;
};

// Canonical bytes (docs/formats.md, "solution"), little-endian doubles. Decoding fails with
// DATA_LOSS and never crashes.
std::string EncodeSolution(const Solution& solution);
absl::StatusOr<Solution> DecodeSolution(const std::string& bytes);

}  // namespace lambert

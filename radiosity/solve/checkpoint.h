// A run after its last finished pass, as bytes from which it goes on.
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "radiosity/solve/replicates.h"
#include "radiosity/solve/sightings.h"
#include "radiosity/solve/solver.h"

namespace lambert {

// Where a run stands, beside what it has found.
struct RunState {
  int32_t next_pass = 0;
  int32_t last_step = 0;
  StopReason stop = StopReason::kNone;
  uint8_t reserved[7] = {};
  int64_t rays = 0, version = 0, pass_rays = 0;
  double cpu_seconds = 0, seconds = 0, unsent_fraction = 1, rays_per_first_ray = 1;
};

std::string EncodeCheckpoint(const RunState& state, const Replicates& replicates,
                             const SightingTable& sightings);

// DATA_LOSS, and nothing changes, on bytes that are not of this patch set.
absl::Status RestoreCheckpoint(const std::string& bytes, RunState& state, Replicates& replicates,
                               SightingTable& sightings);

}  // namespace lambert

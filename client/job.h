// What a client knows of a job: plain data, no protocol types.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "radiosity/core/warning.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solution.h"
#include "radiosity/solve/solver.h"

namespace lambert::client {

// A blob on the server.
struct BlobRef {
  std::string sha256;  // "" while there is none
  int64_t size_bytes = 0;
};

enum class JobState { kQueued, kRunning, kSucceeded, kFailed, kCancelled };

// "queued", "running", "succeeded", "failed", "cancelled".
const char* JobStateName(JobState state);
inline bool HasEnded(JobState state) {
  return state != JobState::kQueued && state != JobState::kRunning;
}

struct Job {
  std::string name;        // "solveJobs/ID"
  std::string scene;       // "scenes/SHA256"
  std::string scene_name;  // "room.glb"
  JobState state = JobState::kQueued;
  StopReason stop_reason = StopReason::kNone;
  bool reached_goal = false;
  absl::Status error;  // of a failed job, with its ErrorDetail
  std::vector<Warning> warnings;
  PatchOptions patch_options;
  SolveOptions solve_options;      // as they were asked for
  Plan plan;                       // patches == 0: not made yet
  std::optional<Meshing> meshing;  // absent until it is done, and where it is off
  BlobRef patch_set;
  Progress progress;
  int64_t snapshot_version = 0;  // of the newest snapshot; 0: none yet
  Progress snapshot_progress;
  BlobRef snapshot;
  std::string unit_version;
};

struct Worker {
  std::string name;
  int slots = 0;   // units that it runs at once
  int leases = 0;  // units that it holds now
  int64_t finished_units = 0;
  double silence_s = 0;  // since it last reported, seconds
};

}  // namespace lambert::client

// What will be done for a scene, what is left out, and why. Pure: nothing is solved.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/options.h"

namespace lambert {

struct PlanItem {
  std::string part;  // PartName, for --with and --without; or "adapt", for --adapt
  std::string item;  // "pyramids", "black patches", ...
  bool left_out = false;
  bool forced = false;  // by --with or --without
  std::string reason;   // one sentence
  std::string saving;   // "" or what leaving it out saves, in words with a number
};

struct Plan {
  // With the method resolved, every part decided that the scene and the method have, and every 0 of
  // a stop rule filled in.
  SolveOptions options;
  std::vector<PlanItem> items;
  int64_t patches = 0;
  int64_t worker_bytes = 0;  // estimated peak memory of one worker with one thread
  int64_t first_pass_rays = 0;
};

// FIELD_INVALID where options that are valid do not fit this scene: as that of ShootOptions says
// (radiosity/shoot/importance.h), or where a part is asked for that cannot be had, or left out that
// cannot be left out. `adapted`: ChooseMethod's.
absl::Status ValidateFor(const PatchSet& patches, const SolveOptions& options,
                         bool adapted = false);

// Requires: ValidateFor is OK with these.
Plan MakePlan(const PatchSet& patches, const SolveOptions& options, bool adapted = false);

// Requires: options of a plan.
int64_t FirstPassRays(const PatchSet& patches, const SolveOptions& planned);

}  // namespace lambert

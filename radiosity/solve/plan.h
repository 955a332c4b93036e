// What will be done for a scene, what is left out, and why. Pure: nothing is solved.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/options.h"

namespace lambert {

struct PlanItem {
  std::string item;  // "pyramids", "black patches", ...
  bool left_out = false;
  std::string reason;  // one sentence
  std::string saving;  // "" or what leaving it out saves, in words with a number
};

struct Plan {
  SolveOptions options;  // with the method resolved and every 0 of a stop rule filled in
  std::vector<PlanItem> items;
  int64_t patches = 0;
  int64_t worker_bytes = 0;  // estimated peak memory of one worker with one thread
  int64_t first_pass_rays = 0;
};

Plan MakePlan(const PatchSet& patches, const SolveOptions& options);

}  // namespace lambert

// Every method with the settings that change where its rays go, as tests name them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "radiosity/solve/options.h"

namespace lambert {

struct MethodCase {
  const char* name;
  Method method;
  std::map<std::string, std::string> settings;  // as `lambert bench` writes them
};

// All that shoot from patches which send evenly what they reflect; the first is mcr.
std::vector<MethodCase> EveryShootingMethod();
// Those whose light goes on from where it arrives.
std::vector<MethodCase> EveryWalk();

// With a ray budget. Pyramids, where used, are for every visit of `min_rays` or more; the region of
// `importance` is the first node.
SolveOptions OptionsOf(const MethodCase& method, int64_t rays, int64_t min_rays = 64);

}  // namespace lambert

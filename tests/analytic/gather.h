// The plainest estimator, as a judge of the others: random walks that gather.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"

namespace lambert {

// Radiosity of every patch, gray scenes' red channel, and its standard error.
struct Walked {
  std::vector<double> radiosity, std_error;
};

// B_i = E_i + rho_i E[E_j + rho_j (...)] over paths that leave each patch at a uniform point in a
// cosine-distributed direction and go on with probability rho. Its own random numbers and sampling;
// shares nothing with the shooting methods but the ray tracer. Requires: no point lights.
Walked GatherByWalks(const PatchSet& patches, int walks_per_patch, uint64_t seed);

}  // namespace lambert

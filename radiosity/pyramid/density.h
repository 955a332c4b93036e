// How a patch's rays are divided over its pyramids.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/pyramid/hemisphere.h"

namespace lambert {

// Fraction of a patch's rays for each pyramid; all > 0, sum 1 (JPS00, 3.2):
//   hf(f_p, n_ip) = (alpha1 f_p + alpha2 g(n_ip)) / (alpha1 + alpha2),  g(n) = n / sum n
// With no patch counted at all, g = f_p. No density falls below a hundredth of f_p: a pyramid whose
// density is zero would never send its flux, whatever stands there (only alpha1 < .01 is changed).
// Requires: counts of hemisphere.size() pyramids, alpha1 and alpha2 >= 0, not both 0.
std::vector<float> PyramidDensities(const Hemisphere& hemisphere,
                                    const std::vector<int32_t>& counts, double alpha1,
                                    double alpha2);

// Rays of each pyramid: r_ip = density_ip r_i, rounded systematically, never away: the fractions
// are carried from pyramid to pyramid starting at `offset` in [0, 1), so that E[r_ip] is exact and
// the sum is exactly `ray_count`.
std::vector<uint32_t> PyramidRays(const std::vector<float>& densities, uint32_t ray_count,
                                  double offset);

}  // namespace lambert

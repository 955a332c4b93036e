// How a patch's rays are divided over the parts of its hemisphere.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/pyramid/hemisphere.h"

namespace lambert {

// Fraction of a patch's rays for each cell; all > 0, sum 1 (JPS00, 3.2):
//   hf_p = (alpha1 f_p + alpha2 g_p) / (alpha1 + alpha2),  g_p = worth_p / sum of worth
// worth: n_ip by the paper's rule, f_p sqrt(S_p) by the rule of least variance. Nothing worth
// anything at all: g = f. No density falls below a hundredth of f_p: a cell whose density is zero
// would never send its flux, whatever stands there (only alpha1 < .01 is changed).
// Requires: f_p (`fractions`) and worth >= 0 for each cell, alpha1 and alpha2 >= 0, not both 0.
std::vector<float> CellDensities(const std::vector<double>& fractions,
                                 const std::vector<double>& worth, double alpha1, double alpha2);

// f_p sqrt(S_p) from f_p S_p, the second moment of what the rays through a cell are worth: rays
// divided like this give the sum over cells the least variance.
std::vector<double> LeastVariance(const std::vector<double>& fractions,
                                  const std::vector<double>& moments);

// A hemisphere cut finely where patches are many and coarsely where they are few.
struct AdaptivePyramids {
  std::vector<const SphericalTriangle*> pyramids;  // of any level; share the hemisphere
  std::vector<double> worth;                       // of each, summed over the finest inside
};
// From the initial triangles on, the pyramid with the greatest worth is split until there are
// `leaves` or none is left to split. Requires: worth >= 0 for each finest pyramid of `hemisphere`.
AdaptivePyramids SplitWhereWorthIs(const Hemisphere& hemisphere, const std::vector<double>& worth,
                                   int leaves);

// Rays of each cell: r_ip = density_ip r_i, rounded systematically, never away: the fractions
// are carried from cell to cell starting at `offset` in [0, 1), so that E[r_ip] is exact and
// the sum is exactly `ray_count`.
std::vector<uint32_t> CellRays(const std::vector<float>& densities, uint32_t ray_count,
                               double offset);

}  // namespace lambert

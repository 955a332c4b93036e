// Solutions over several seeds, and what their spread says.
#pragma once

#include <functional>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/options.h"
#include "radiosity/solve/solution.h"

namespace lambert {

// Solutions with seeds first .. first + count - 1, each in this thread.
std::vector<Solution> SolveSeeds(const PatchSet& patches, const SolveOptions& options, int count,
                                 uint64_t first = 1);

struct Estimate {
  double mean = 0;
  double std_error = 0;  // of the mean, from the spread over the seeds
};
Estimate Over(const std::vector<Solution>& solutions,
              const std::function<double(const Solution&)>& value);

// Area-weighted mean of a quantity over all patches, red channel.
double AreaMean(const PatchSet& patches, const std::vector<Rgb>& values);

// Options of a method with a ray budget; pyramids, where used, for every visit of 64 rays or more.
SolveOptions WithRays(Method method, int64_t rays);

inline constexpr int kSeeds = 16;

// A number that a solution should have.
struct Truth {
  const char* what;
  double value;
  std::function<double(const Solution&)> of;
};

// Each must be within 3 standard errors of its mean over 16 seeds, and that standard error under
// .5 % of it. Chance alone puts one in a hundred correct numbers outside (Student's t with 15
// degrees of freedom), so what is outside must be inside with 64 other seeds: one in 40,000 then
// fails by chance, and a true bias of 3 standard errors is the better seen.
void ExpectTruths(const PatchSet& patches, const SolveOptions& options,
                  const std::vector<Truth>& truths);

}  // namespace lambert

#include "tests/analytic/seeds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"

namespace lambert {

std::vector<Solution> SolveSeeds(const PatchSet& patches, const SolveOptions& options, int count,
                                 uint64_t first) {
  auto shared = std::make_shared<const PatchSet>(patches);
  auto shooter = Shooter::Create(shared, MakePlan(*shared, options).options.shoot);
  EXPECT_TRUE(shooter.ok()) << shooter.status();
  SerialExecutor executor(*shooter);
  std::vector<Solution> solutions;
  for (uint64_t seed = first; seed < first + static_cast<uint64_t>(count); ++seed) {
    SolveOptions seeded = options;
    seeded.seed = seed;
    Solver solver(shared, MakePlan(*shared, seeded).options, [] { return 0.0; });
    while (solver.stop_reason() == StopReason::kNone) {
      const absl::Status status = solver.RunPass(executor, nullptr);
      EXPECT_TRUE(status.ok()) << status;
      if (!status.ok()) return solutions;
    }
    solutions.push_back(*solver.MakeSnapshot().solution);
  }
  return solutions;
}

Estimate Over(const std::vector<Solution>& solutions,
              const std::function<double(const Solution&)>& value) {
  const double n = static_cast<double>(solutions.size());
  double sum = 0, squares = 0;
  for (const Solution& solution : solutions) sum += value(solution);
  for (const Solution& solution : solutions) {
    const double d = value(solution) - sum / n;
    squares += d * d;
  }
  return {sum / n, std::sqrt(squares / (n - 1) / n)};
}

double AreaMean(const PatchSet& patches, const std::vector<Rgb>& values) {
  double sum = 0, area = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    sum += patches.area_m2[i] * values[i].r;
    area += patches.area_m2[i];
  }
  return sum / area;
}

SolveOptions WithRays(Method method, int64_t rays) {
  SolveOptions options;
  options.shoot.method = method;
  options.shoot.pyramids.min_rays = 64;
  options.max_rays = rays;
  return options;
}

void ExpectTruths(const PatchSet& patches, const SolveOptions& options,
                  const std::vector<Truth>& truths) {
  const std::vector<Solution> solutions = SolveSeeds(patches, options, kSeeds);
  std::vector<Solution> confirming;
  for (const Truth& truth : truths) {
    Estimate estimate = Over(solutions, truth.of);
    EXPECT_LT(estimate.std_error, 0.005 * std::abs(truth.value)) << truth.what;
    if (std::abs(estimate.mean - truth.value) > 3 * estimate.std_error) {
      if (confirming.empty()) confirming = SolveSeeds(patches, options, 4 * kSeeds, 1000);
      estimate = Over(confirming, truth.of);
    }
    EXPECT_NEAR(estimate.mean, truth.value, 3 * estimate.std_error) << truth.what;
  }
}

}  // namespace lambert

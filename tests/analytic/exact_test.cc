// The judge before its own judges: closed-form solutions, to the digits that they have.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

std::vector<double> SortedRadiosity(const PatchSet& patches) {
  const std::vector<Solution> solved = SolveSeeds(patches, WithRays(Method::kExact, 100000), 1);
  std::vector<double> sorted;
  for (const Rgb& b : solved.at(0).radiosity_lm_per_m2) sorted.push_back(b.r);
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

TEST(Exact, SolvesParallelSquares) {
  struct Case {
    double rho, b_a, b_b;
  };
  for (const Case& c :
       {Case{0.5, 1.010083152275, 0.1009198802750}, Case{0.9, 1.033424344339, 0.1858535206377},
        Case{1.0, 1.0415907053453544, 0.20813575405604529}}) {
    const auto b = SortedRadiosity(PatchesOf(MakeParallelSquares(c.rho, c.rho)));
    EXPECT_NEAR(b[0], c.b_b, 1e-11);
    EXPECT_NEAR(b[1], c.b_b, 1e-11);
    EXPECT_NEAR(b[2], c.b_a, 1e-11);
    EXPECT_NEAR(b[3], c.b_a, 1e-11);
  }
}

TEST(Exact, SolvesPerpendicularSquares) {
  const auto b = SortedRadiosity(PatchesOf(MakePerpendicularSquares(0.8, 0.3)));
  const double expected[] = {0.04013015480378, 0.08138899632311, 1.006110930627, 1.015568282603};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(b[k], expected[k], 1e-11);
}

TEST(Exact, SolvesTheCubeOf12Triangles) {
  for (const auto& [rho, expected] : {std::pair{0.5, 0.1777485977549}, {0.9, 1.513308078238}}) {
    std::vector<Rgb> exitance(6);
    exitance[3] = {1, 1, 1};  // the ceiling, +y
    const PatchSet patches = PatchesOf(MakeBox(1, {rho, rho, rho}, exitance));
    const Solution solution = SolveSeeds(patches, WithRays(Method::kExact, 100000), 1).at(0);
    double floor = 0;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      if (PatchNormal(patches, i).y > 0.5) floor += solution.radiosity_lm_per_m2[i].r / 2;
    }
    EXPECT_NEAR(floor, expected, 1e-11);
    EXPECT_NEAR(6 * AreaMean(patches, solution.radiosity_lm_per_m2), 1 / (1 - rho), 1e-11);
  }
}

// A closed room with a closed box in it: every patch sees light alike, whatever hides what, and the
// rows are known to sum to one.
TEST(Exact, SolvesAFurnaceWithABoxInIt) {
  for (const double rho : {0.5, 0.999}) {
    const Paint paint{{rho, rho, rho}, {1, 1, 1}};
    const PatchSet patches = PatchesOf(SceneMaker()
                                           .Box({0, 0, 0}, {2, 2, 2}, true, {paint}, 4)
                                           .Box({0.5, 0.6, 0.7}, {1.2, 1.4, 1.5}, false, {paint}, 2)
                                           .Make());
    const Solution solution = SolveSeeds(patches, WithRays(Method::kExact, 100000), 1).at(0);
    for (const Rgb& b : solution.radiosity_lm_per_m2) EXPECT_NEAR(b.r * (1 - rho), 1, 1e-9);
  }
}

// The same room where a wall is the lamp: power is known, sum A B = sum A E / (1 - rho).
TEST(Exact, KeepsThePowerOfAClosedRoomWithABoxInIt) {
  const double rho = 0.9;
  std::vector<Paint> walls(6, Paint{{rho, rho, rho}, {}});
  walls[3].exitance_lm_per_m2 = {1, 1, 1};
  const PatchSet patches =
      PatchesOf(SceneMaker()
                    .Box({0, 0, 0}, {2, 2, 2}, true, walls, 4)
                    .Box({0.5, 0.6, 0.7}, {1.2, 1.4, 1.5}, false, {walls[0]}, 2)
                    .Make());
  double area = 0;
  for (double a : patches.area_m2) area += a;
  const Solution solution = SolveSeeds(patches, WithRays(Method::kExact, 100000), 1).at(0);
  EXPECT_NEAR(AreaMean(patches, solution.radiosity_lm_per_m2) * area, 4 / (1 - rho), 1e-9);
}

// The standard error that a solution states is that over the seeds.
TEST(Exact, StatesItsError) {
  const PatchSet patches = PatchesOf(MakeCornell(2));
  const auto solutions = SolveSeeds(patches, WithRays(Method::kExact, 400000), kSeeds);
  double stated = 0, true_variance = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Estimate b =
        Over(solutions, [&](const Solution& s) { return s.radiosity_lm_per_m2[i].r; });
    true_variance += b.std_error * b.std_error * kSeeds;
    for (const Solution& s : solutions) {
      stated += s.std_error_lm_per_m2[i].r * s.std_error_lm_per_m2[i].r / kSeeds;
    }
  }
  EXPECT_GT(stated / true_variance, 0.64);  // root: 0.8 to 1.25
  EXPECT_LT(stated / true_variance, 1.56);
}

}  // namespace
}  // namespace lambert

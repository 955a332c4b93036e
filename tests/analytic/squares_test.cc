// Two unit squares, face to face and at a right angle: the exact solutions for constant radiosity
// per triangle (form factors by Howell C-11 and C-14).
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// Mean radiosity of the patches of one square: node 0 is a, the emitter, node 1 is b.
double SquareMean(const PatchSet& patches, const Solution& solution, int node) {
  double sum = 0;
  int count = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (patches.source[i].node != node) continue;
    sum += solution.radiosity_lm_per_m2[i].r;
    ++count;
  }
  return sum / count;
}

struct Case {
  const char* name;
  bool parallel;
  double rho_a, rho_b, b_a, b_b;
};

class Squares : public testing::TestWithParam<std::tuple<Method, Case>> {};

TEST_P(Squares, HaveTheExactRadiosity) {
  const auto& [method, c] = GetParam();
  const PatchSet patches = PatchesOf(c.parallel ? MakeParallelSquares(c.rho_a, c.rho_b)
                                                : MakePerpendicularSquares(c.rho_a, c.rho_b));
  ExpectTruths(patches, WithRays(method, 200000),
               {{"square a", c.b_a, [&](const Solution& s) { return SquareMean(patches, s, 0); }},
                {"square b", c.b_b, [&](const Solution& s) { return SquareMean(patches, s, 1); }}});
}

// For the parallel squares the triangles' solution is the squares' own, by symmetry.
INSTANTIATE_TEST_SUITE_P(
    All, Squares,
    testing::Combine(
        testing::Values(Method::kPmcr, Method::kPhs),
        testing::Values(Case{"Parallel5", true, 0.5, 0.5, 1.010083152275, 0.1009198802750},
                        Case{"Parallel9", true, 0.9, 0.9, 1.033424344339, 0.1858535206377},
                        Case{"Albedo1", true, 1.0, 1.0, 1.0415907053453544, 0.20813575405604529},
                        Case{"Perpendicular", false, 0.8, 0.3,
                             0.5 * (1.006110930627 + 1.015568282603),
                             0.5 * (0.08138899632311 + 0.04013015480378)})),
    [](const auto& info) {
      return std::string(MethodName(std::get<0>(info.param))) + std::get<1>(info.param).name;
    });

TEST(PerpendicularSquares, EachTriangleHasItsExactRadiosity) {
  const PatchSet patches = PatchesOf(MakePerpendicularSquares(0.8, 0.3));
  const auto kth = [](int k) {
    return [k](const Solution& s) {
      std::vector<double> sorted;
      for (const Rgb& b : s.radiosity_lm_per_m2) sorted.push_back(b.r);
      std::sort(sorted.begin(), sorted.end());
      return sorted[k];
    };
  };
  ExpectTruths(patches, WithRays(Method::kPmcr, 1000000),
               {{"darkest triangle of b", 0.04013015480378, kth(0)},
                {"brightest triangle of b", 0.08138899632311, kth(1)},
                {"darkest triangle of a", 1.006110930627, kth(2)},
                {"brightest triangle of a", 1.015568282603, kth(3)}});
}

}  // namespace
}  // namespace lambert

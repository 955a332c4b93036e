// Closed scenes of uniform reflectance and exitance, any shape, any mesh: B = E / (1 - rho).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

class Furnace : public testing::TestWithParam<std::tuple<Method, double>> {};

TEST_P(Furnace, HasTheClosedFormRadiosity) {
  const auto [method, rho] = GetParam();
  const PatchSet patches = PatchesOf(MakeFurnace(rho, 1, 2));
  // The power's relative error is about sqrt(rho / (N (1 - rho))): N per seed for .2 % over 16.
  const int64_t rays = static_cast<int64_t>(2e4 / (1 - rho));
  ExpectTruths(patches, WithRays(method, rays),
               {{"mean radiosity", 1 / (1 - rho),
                 [&](const Solution& s) { return AreaMean(patches, s.radiosity_lm_per_m2); }}});
}

std::string FurnaceName(const testing::TestParamInfo<Furnace::ParamType>& info) {
  return std::string(MethodName(std::get<0>(info.param))) + "Rho" +
         std::to_string(std::lround(1e5 * std::get<1>(info.param)));
}

INSTANTIATE_TEST_SUITE_P(Reflectances, Furnace,
                         testing::Combine(testing::Values(Method::kPmcr, Method::kPhs),
                                          testing::Values(0.1, 0.5, 0.8, 0.9)),
                         FurnaceName);
INSTANTIATE_TEST_SUITE_P(Stiff, Furnace,
                         testing::Combine(testing::Values(Method::kPmcr), testing::Values(0.99)),
                         FurnaceName);

TEST(FurnaceSphere, EveryPatchAgreesWithinItsStandardError) {
  const PatchSet patches = PatchesOf(MakeIcosphere(2, {{0.8, 0.8, 0.8}, {1, 1, 1}, false}));
  const auto solutions = SolveSeeds(patches, WithRays(Method::kPmcr, 400000), kSeeds);
  double z2 = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Estimate b =
        Over(solutions, [&](const Solution& s) { return s.radiosity_lm_per_m2[i].r; });
    z2 += std::pow((b.mean - 5) / b.std_error, 2);
  }
  // Student's t with 15 degrees of freedom has variance 15/13; the mean over n patches spreads by
  // about sqrt(2 / n) of it, and twice that for their correlation.
  const double n = patches.size(), expected = 15.0 / 13;
  EXPECT_NEAR(z2 / n, expected, 3 * 2 * expected * std::sqrt(2 / n));
}

TEST(FurnaceSphere, EscapedFluxIsThatOfTheHole) {
  // Without some of its patches the sphere is a cavity: with F_ij = A_j / A, the sphere's wall has
  // B = E / (1 - rho (1 - a)) where a is the fraction of its area that is open.
  PatchSet patches = PatchesOf(MakeIcosphere(3, {{0.8, 0.8, 0.8}, {1, 1, 1}, false}));
  PatchSet open = patches;
  const PatchIndex n = patches.size(), kept = n - n / 10;
  open.corners.resize(kept);
  open.area_m2.resize(kept);
  open.reflectance.resize(kept);
  open.exitance_lm_per_m2.resize(kept);
  open.twin.resize(kept);
  open.is_back.resize(kept);
  open.source.resize(kept);
  double all = 0, wall = 0;
  for (PatchIndex i = 0; i < n; ++i) (i < kept ? wall : all) += patches.area_m2[i];
  all += wall;
  const auto solutions = SolveSeeds(open, WithRays(Method::kPmcr, 200000), kSeeds);
  const Estimate b =
      Over(solutions, [&](const Solution& s) { return AreaMean(open, s.radiosity_lm_per_m2); });
  // An icosphere of 1280 faces differs from a sphere by under .1 % here.
  EXPECT_NEAR(b.mean, 1 / (1 - 0.8 * wall / all), 3 * b.std_error + 0.001 * b.mean);
  const Estimate escaped =
      Over(solutions, [](const Solution& s) { return s.ledger.escaped.r / s.ledger.emitted.r; });
  EXPECT_NEAR(escaped.mean, b.mean * (1 - wall / all), 3 * escaped.std_error + 0.001);
}

}  // namespace
}  // namespace lambert

// CIE 171:2006, case 5.8: a 4 m cube with an isotropic 10,000 lm point source at its centre. The
// area mean of the indirect illuminance is phi / S rho / (1 - rho), S = 96 m2.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

class Cie171Case58 : public testing::TestWithParam<double> {};

TEST_P(Cie171Case58, MeanIndirectIlluminance) {
  const double rho = GetParam();
  SceneMaker maker;
  maker.Box({0, 0, 0}, {4, 4, 4}, /*inward=*/true, {Paint{{rho, rho, rho}, {}}});
  const double intensity_cd = 10000 / (4 * std::numbers::pi);
  maker.Light({2, 2, 2}, {intensity_cd, intensity_cd, intensity_cd});
  const PatchSet patches = PatchesOf(maker.Make());
  // All direct light arrives: its mean is phi / S without error.
  ExpectTruths(
      patches, WithRays(Method::kPmcr, static_cast<int64_t>(4e4 / (1 - rho) / rho)),
      {{"mean indirect illuminance", 10000.0 / 96 * rho / (1 - rho),
        [&](const Solution& s) { return AreaMean(patches, s.irradiance_lx) - 10000.0 / 96; }}});
}

INSTANTIATE_TEST_SUITE_P(Reflectances, Cie171Case58,
                         testing::Values(0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95),
                         [](const auto& info) {
                           return "Rho" + std::to_string(std::lround(100 * info.param));
                         });

}  // namespace
}  // namespace lambert

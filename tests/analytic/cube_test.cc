// The unit cube of 12 triangles, its ceiling emitting 1 lm/m2: (I - rho F) B = E with the exact
// 12 x 12 form factors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

struct Case {
  double rho, floor;
};

class Cube12 : public testing::TestWithParam<std::tuple<Method, Case>> {};

TEST_P(Cube12, FloorAndBalanceAreExact) {
  const auto& [method, c] = GetParam();
  std::vector<Rgb> exitance(6);
  exitance[3] = {1, 1, 1};  // the ceiling, +y
  const PatchSet patches = PatchesOf(MakeBox(1, {c.rho, c.rho, c.rho}, exitance));
  const auto floor = [&](const Solution& s) {
    double sum = 0;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      if (PatchNormal(patches, i).y > 0.5) sum += s.radiosity_lm_per_m2[i].r;
    }
    return sum / 2;
  };
  // The sum of A B over a closed scene of uniform reflectance is that of A E / (1 - rho).
  const auto balance = [&](const Solution& s) {
    return 6 * AreaMean(patches, s.radiosity_lm_per_m2);
  };
  ExpectTruths(patches, WithRays(method, static_cast<int64_t>(1e5 / (1 - c.rho))),
               {{"sum of A B", 1 / (1 - c.rho), balance}, {"floor", c.floor, floor}});
}

std::string CubeName(const testing::TestParamInfo<Cube12::ParamType>& info) {
  std::string name = MethodName(std::get<0>(info.param));
  name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
  return name + "Rho" + std::to_string(std::lround(100 * std::get<1>(info.param).rho));
}

// The floor's triangles are alike if both its diagonal and the ceiling's run the same way, which
// does not change their mean.
INSTANTIATE_TEST_SUITE_P(All, Cube12,
                         testing::Combine(testing::Values(Method::kPmcr, Method::kPhs),
                                          testing::Values(Case{0.5, 0.1777485977549},
                                                          Case{0.9, 1.513308078238})),
                         CubeName);
INSTANTIATE_TEST_SUITE_P(Others, Cube12,
                         testing::Combine(testing::Values(Method::kMcr, Method::kHs97,
                                                          Method::kHs98, Method::kPhsAlpha,
                                                          Method::kPhsAdaptive, Method::kPhsHier),
                                          testing::Values(Case{0.5, 0.1777485977549})),
                         CubeName);

}  // namespace
}  // namespace lambert

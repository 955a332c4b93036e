// Scenes that hardly lose any light at a bounce: thousands of steps, but for flux shot ahead
// (radiosity/solve/ambient.h). Truths are closed forms, or the exact method's where nothing
// occludes.
#include <gtest/gtest.h>

#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

Paint Gray(double rho, double exitance = 0) {
  return {{rho, rho, rho}, {exitance, exitance, exitance}};
}

// The power of a node's patches, red channel [lm].
double NodePower(const PatchSet& patches, const Solution& solution, int32_t node) {
  double power = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (patches.source[i].node == node) {
      power += patches.area_m2[i] * solution.radiosity_lm_per_m2[i].r;
    }
  }
  return power;
}

Truth PowerOf(const PatchSet& patches, int32_t node, double value) {
  return {"power", value,
          [&patches, node](const Solution& s) { return NodePower(patches, s, node); }};
}

// A box of six walls, each a node.
SceneMaker Room(const std::vector<Paint>& walls, Vec3 low = {0, 0, 0}, int n = 2) {
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  SceneMaker maker;
  maker.Quad(low, x, y, walls[0], n)
      .Quad(low + z, y, x, walls[1], n)
      .Quad(low, y, z, walls[2], n)
      .Quad(low + x, z, y, walls[3], n)
      .Quad(low, z, x, walls[4], n)
      .Quad(low + y, x, z, walls[5], n);
  return maker;
}

// The powers of six walls, as the exact method has them.
void ExpectWallsAsExact(const PatchSet& patches, const SolveOptions& options) {
  const Solution exact = SolveSeeds(patches, WithRays(Method::kExact, 1000), 1).at(0);
  std::vector<Truth> truths;
  for (int32_t wall = 0; wall < 6; ++wall) {
    if (const double power = NodePower(patches, exact, wall); power > 0) {
      truths.push_back(PowerOf(patches, wall, power));
    }
  }
  ExpectTruths(patches, options, truths);
}

class Stiff : public testing::TestWithParam<Method> {
 protected:
  SolveOptions Rays(int64_t rays) const {
    SolveOptions options = WithRays(GetParam(), rays);
    if (GetParam() == Method::kImportance) options.shoot.region = {"0"};
    if (GetParam() == Method::kHs97) options.shoot.pyramids.probes = 1;
    return options;
  }
};

TEST_P(Stiff, FurnacesHaveTheClosedFormRadiosity) {
  for (double loss : {1e-4, 1e-6}) {
    const PatchSet patches = PatchesOf(Room(std::vector<Paint>(6, Gray(1 - loss, 1))).Make());
    std::vector<Truth> truths;
    for (int32_t wall = 0; wall < 6; ++wall) truths.push_back(PowerOf(patches, wall, 1 / loss));
    ExpectTruths(patches, Rays(40000), truths);
  }
}

// The lamp is one wall; the others lose between 1e-2 and 1e-5, so that the loss of the room must be
// learned from its rays.
TEST_P(Stiff, WallsOfUnequalReflectanceAgreeWithExact) {
  const PatchSet patches = PatchesOf(
      Room({Gray(0.99, 1), Gray(0.999), Gray(0.9999), Gray(0.99999), Gray(0.99), Gray(0.999)})
          .Make());
  ExpectWallsAsExact(patches, Rays(250000));
}

// No light is absorbed: it leaves by a slit, or comes back: one ray in a hundred tells.
TEST_P(Stiff, AWhiteRoomWithAHoleAgreesWithExact) {
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, Gray(1, 1), 2)
                                         .Quad({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, Gray(1), 2)
                                         .Quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, Gray(1), 2)
                                         .Quad({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, Gray(1), 2)
                                         .Quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, Gray(1), 2)
                                         .Quad({0.05, 1, 0}, {0.95, 0, 0}, {0, 0, 1}, Gray(1), 2)
                                         .Make());
  ExpectWallsAsExact(patches, Rays(1000000));
}

std::string NameOf(const testing::TestParamInfo<Method>& info) {
  std::string name = MethodName(info.param);
  std::erase(name, '-');
  return name;
}
INSTANTIATE_TEST_SUITE_P(EveryMethod, Stiff,
                         testing::Values(Method::kMcr, Method::kPmcr, Method::kHs97, Method::kHs98,
                                         Method::kPhs, Method::kPhsAlpha, Method::kPhsAdaptive,
                                         Method::kPhsHier, Method::kImportance),
                         NameOf);

// Each converges as if it were alone: what is known of one does not disturb the other.
TEST(StiffRooms, TwoFurnacesConvergeEach) {
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Box({0, 0, 0}, {1, 1, 1}, true, {Gray(0.9999, 1)}, 2)
                                         .Box({1, 0, 0}, {2, 1, 1}, true, {Gray(0.5, 1000)}, 2)
                                         .Box({0, 2, 0}, {1, 3, 1}, true, {Gray(0.99999)}, 2)
                                         .Make());
  ExpectTruths(patches, WithRays(Method::kPmcr, 100000),
               {PowerOf(patches, 0, 6e4), PowerOf(patches, 1, 12000)});
  for (const Solution& s : SolveSeeds(patches, WithRays(Method::kPmcr, 10000), 2)) {
    EXPECT_EQ(NodePower(patches, s, 2), 0) << "no light reaches it";
  }
}

// Transport along it is slow as diffusion is, and its light is far from uniform.
TEST(StiffRooms, ACorridorLitFromOneEndKeepsItsPower) {
  const double rho = 0.999;
  std::vector<Paint> walls(6, Gray(rho));
  walls[0] = Gray(rho, 1);
  const PatchSet patches =
      PatchesOf(SceneMaker().Box({0, 0, 0}, {30, 1, 1}, true, walls, 6).Make());
  ExpectTruths(patches, WithRays(Method::kPmcr, 400000), {PowerOf(patches, 0, 1 / (1 - rho))});
}

// A point light is no patch: its flux is known where it arrives.
TEST(StiffRooms, APointLightInAFurnaceKeepsItsPower) {
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Box({0, 0, 0}, {1, 1, 1}, true, {Gray(0.9999)}, 2)
                                         .Light({0.4, 0.5, 0.6}, {1, 1, 1})
                                         .Make());
  const double flux = patches.lights[0].strength.r * 4 * 3.14159265358979323846;
  ExpectTruths(patches, WithRays(Method::kPmcr, 100000),
               {PowerOf(patches, 0, flux * 0.9999 / 1e-4)});
}

}  // namespace
}  // namespace lambert

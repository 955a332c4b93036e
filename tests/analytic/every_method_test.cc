// Every method, with every setting that changes where its rays go, before the same closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tests/analytic/methods.h"
#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// A scene, and numbers that its solution has.
struct Room {
  const char* name;
  std::function<Scene()> make;
  std::function<std::vector<Truth>(const PatchSet&)> truths;
  int64_t rays;                // of a seed: 16 of them are within .5 %
  bool is_of_patches = false;  // the numbers are of patches that send evenly what they reflect
};

// B = E / (1 - rho) whatever the shape: the mean over the room, and over each half of its patches.
std::vector<Truth> FurnaceTruths(const PatchSet& patches, double rho) {
  const PatchIndex n = patches.size();
  const auto over = [](PatchIndex first, PatchIndex end) {
    return [first, end](const Solution& s) {
      double sum = 0;
      for (PatchIndex i = first; i < end; ++i) sum += s.radiosity_lm_per_m2[i].r;
      return sum / (end - first);
    };
  };
  const double b = 1 / (1 - rho);
  return {{"mean radiosity", b,
           [patches](const Solution& s) { return AreaMean(patches, s.radiosity_lm_per_m2); }},
          {"radiosity of one half", b, over(0, n / 2)},
          {"radiosity of the other half", b, over(n / 2, n)}};
}

// Mean radiosity of the patches of a node.
Truth NodeMean(const char* what, double value, const PatchSet& patches, int node) {
  return {what, value, [patches, node](const Solution& s) {
            double sum = 0, count = 0;
            for (PatchIndex i = 0; i < patches.size(); ++i) {
              if (patches.source[i].node != node) continue;
              sum += s.radiosity_lm_per_m2[i].r;
              ++count;
            }
            return sum / count;
          }};
}

// CIE 171:2006, case 5.8, with a reflectance of .5: 10,000 / 96 lx of indirect light.
Scene MakeCie58() {
  const double cd = 10000 / (4 * std::numbers::pi);
  return SceneMaker()
      .Box({0, 0, 0}, {4, 4, 4}, /*inward=*/true, {Paint{{0.5, 0.5, 0.5}, {}}}, 3)
      .Light({2, 2, 2}, {cd, cd, cd})
      .Make();
}

std::vector<Room> Rooms() {
  const auto furnace = [](double rho) {
    return [rho](const PatchSet& patches) { return FurnaceTruths(patches, rho); };
  };
  return {{"Icosphere",
           [] {
             return MakeIcosphere(2, {{0.8, 0.8, 0.8}, {1, 1, 1}, false});
           },
           furnace(0.8), 50000},
          {"JitteredMesh", [] { return MakeJitteredFurnace(0.8, 1, 7); }, furnace(0.8), 50000},
          {"LShapedRoom", [] { return MakeLShapedFurnace(0.8, 1, 3); }, furnace(0.8), 50000},
          {"Cie58", MakeCie58,
           [](const PatchSet& patches) {
             return std::vector<Truth>{
                 {"mean indirect illuminance", 10000.0 / 96, [patches](const Solution& s) {
                    return AreaMean(patches, s.irradiance_lx) - 10000.0 / 96;
                  }}};
           },
           50000},
          {"ParallelSquares", [] { return MakeParallelSquares(0.5, 0.5); },
           [](const PatchSet& patches) {
             return std::vector<Truth>{NodeMean("square a", 1.010083152275, patches, 0),
                                       NodeMean("square b", 0.1009198802750, patches, 1)};
           },
           50000, true},
          {"PerpendicularSquares", [] { return MakePerpendicularSquares(0.8, 0.3); },
           [](const PatchSet& patches) {
             return std::vector<Truth>{
                 NodeMean("square a", 0.5 * (1.006110930627 + 1.015568282603), patches, 0),
                 NodeMean("square b", 0.5 * (0.08138899632311 + 0.04013015480378), patches, 1)};
           },
           100000, true}};
}

class EveryMethod : public testing::TestWithParam<Room> {};

TEST_P(EveryMethod, HasTheClosedForm) {
  const Room& room = GetParam();
  const PatchSet patches = PatchesOf(room.make());
  std::vector<MethodCase> methods = EveryShootingMethod();
  if (!room.is_of_patches) {
    for (const MethodCase& walk : EveryWalk()) methods.push_back(walk);
  }
  for (const MethodCase& method : methods) {
    SCOPED_TRACE(method.name);
    ExpectTruths(patches, OptionsOf(method, room.rays, /*min_rays=*/16), room.truths(patches));
  }
  const Solution exact = SolveSeeds(patches, WithRays(Method::kExact, 100000), 1).at(0);
  for (const Truth& truth : room.truths(patches)) {
    EXPECT_NEAR(truth.of(exact) / truth.value, 1, 1e-9) << "exact: " << truth.what;
  }
}

INSTANTIATE_TEST_SUITE_P(ClosedForms, EveryMethod, testing::ValuesIn(Rooms()),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace lambert

// Walks see the light of the scene, not of patches that send it evenly: a coarse room has the light
// of a fine one.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

// One wall emits.
Scene LitFromOneSide(int n) {
  const Rgb dark{}, light{1, 1, 1};
  return MakeBox(1, {0.8, 0.8, 0.8}, {light, dark, dark, dark, dark, dark}, n);
}

// Whether a point of the plane of a patch lies on it.
bool IsOn(const PatchSet& patches, PatchIndex patch, Vec3 point) {
  const auto& corners = patches.corners[patch];
  const Vec3 normal = PatchNormal(patches, patch);
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = corners[(k + 1) % 3] - corners[k];
    if (Dot(Cross(edge, point - corners[k]), normal) < 0) return false;
  }
  return std::fabs(Dot(point - corners[0], normal)) < 1e-9;
}

// The mean irradiance of the coarse patches, by the fine patches on them.
std::vector<double> OnCoarse(const PatchSet& coarse, const PatchSet& fine,
                             const Solution& solution) {
  std::vector<double> flux(coarse.size());
  for (PatchIndex i = 0; i < fine.size(); ++i) {
    const auto& [a, b, c] = fine.corners[i];
    const Vec3 middle = (a + b + c) / 3 + fine.origin - coarse.origin;
    for (PatchIndex j = 0; j < coarse.size(); ++j) {
      if (IsOn(coarse, j, middle)) flux[j] += fine.area_m2[i] * solution.irradiance_lx[i].r;
    }
  }
  for (PatchIndex j = 0; j < coarse.size(); ++j) flux[j] /= coarse.area_m2[j];
  return flux;
}

// Against closed forms: the exact method on 3,072 patches, whose own error is a tenth of what
// twelve patches of one value each are wrong by, or less.
TEST(Walk, HasTheLightOfAFineRoomOnTwelvePatches) {
  const PatchSet coarse = PatchesOf(LitFromOneSide(1)), fine = PatchesOf(LitFromOneSide(16));
  const auto exact_on = [](const PatchSet& patches) {
    return SolveSeeds(patches, WithRays(Method::kExact, 1), 1).at(0);
  };
  const std::vector<double> expected = OnCoarse(coarse, fine, exact_on(fine));
  const Solution of_patches = exact_on(coarse);
  std::vector<Truth> truths;
  double worst = 0;
  for (PatchIndex j = 0; j < coarse.size(); ++j) {
    worst = std::max(worst, std::fabs(of_patches.irradiance_lx[j].r / expected[j] - 1));
    truths.push_back({"irradiance", expected[j],
                      [j](const Solution& solution) { return solution.irradiance_lx[j].r; }});
  }
  EXPECT_GT(worst, 0.02) << "patches of one value each would pass too";
  ExpectTruths(coarse, WithRays(Method::kWalk, 200000), truths);
}

// Under a table a floor of two triangles has a shadow that it would spread over all of itself.
TEST(Walk, LosesNoLightUnderATable) {
  const auto room = [](int n) {
    const Paint gray{{0.5, 0.5, 0.5}, {}}, lamp{{0.5, 0.5, 0.5}, {10, 10, 10}};
    return SceneMaker()
        .Box({0, 0, 0}, {2, 1, 2}, true, {gray, gray, gray, lamp, gray, gray}, n)
        .Box({0.5, 0, 0.5}, {1.5, 0.3, 1.5}, false, {gray}, n)
        .Make();
  };
  const PatchSet coarse = PatchesOf(room(1)), fine = PatchesOf(room(12));
  const auto power = [](const PatchSet& patches, const SolveOptions& options) {
    return Over(SolveSeeds(patches, options, kSeeds), [&patches](const Solution& solution) {
      return AreaMean(patches, solution.irradiance_lx);
    });
  };
  const Estimate walked = power(coarse, WithRays(Method::kWalk, 200000));
  const Estimate truth = power(fine, WithRays(Method::kWalk, 400000));
  const Estimate spread = power(coarse, WithRays(Method::kPmcr, 200000));
  const double noise = std::hypot(walked.std_error, truth.std_error);
  EXPECT_NEAR(walked.mean, truth.mean, 4 * noise);
  EXPECT_LT(spread.mean, truth.mean - 10 * noise) << "what ends at the table's underside is lost";
}

// Each channel has its own reflectance, though one roulette ends them all: a furnace of walls with
// any reflectances keeps E / (1 - rho).
TEST(Walk, KeepsEachChannelOfAColoredFurnace) {
  Scene scene = MakeFurnace(0.5, 1, 2);
  scene.materials[0].reflectance = {0.9, 0.5, 0.1};
  const PatchSet patches = PatchesOf(scene);
  std::vector<Truth> truths;
  for (int c = 0; c < 3; ++c) {
    const double rho = patches.reflectance[0][c];
    truths.push_back({"radiosity", 1 / (1 - rho), [&patches, c](const Solution& solution) {
                        double sum = 0, area = 0;
                        for (PatchIndex i = 0; i < patches.size(); ++i) {
                          sum += patches.area_m2[i] * solution.radiosity_lm_per_m2[i][c];
                          area += patches.area_m2[i];
                        }
                        return sum / area;
                      }});
  }
  EXPECT_GT(truths[0].value, truths[2].value);
  ExpectTruths(patches, WithRays(Method::kWalk, 100000), truths);
}

}  // namespace
}  // namespace lambert

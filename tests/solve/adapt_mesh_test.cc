#include "radiosity/solve/adapt_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/solve/run_solver.h"

namespace lambert {
namespace {

constexpr double kLampHeight_m = 3, kScreenHeight_m = 1.5, kScreen_m = 0.5, kLamp_m = 0.02;

// A floor of 4 x 4 m under a small lamp; a black square between them throws a hard shadow with
// edges at +-1 m.
Scene MakeShadow() {
  const double s = kScreen_m, l = kLamp_m;
  const Paint screen{{}, {}, true}, lamp{{}, {1e4, 1e4, 1e4}, false};
  return SceneMaker()
      .Quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, {{0.5, 0.5, 0.5}, {}})
      .Quad({-s, -s, kScreenHeight_m}, {2 * s, 0, 0}, {0, 2 * s, 0}, screen)
      .Quad({-l, -l, kLampHeight_m}, {0, 2 * l, 0}, {2 * l, 0, 0}, lamp)
      .Make();
}

struct Adapted {
  std::shared_ptr<const PatchSet> patches;
  Meshing meshing;
};

Adapted Adapt(const Scene& scene, int64_t budget, const SolveOptions& solve = {},
              PatchOptions options = {}) {
  options.adapt_patches = budget;
  Adapted adapted;
  const auto run = [&](const std::shared_ptr<const PatchSet>& patches, const SolveOptions& pilot,
                       int32_t number) -> absl::StatusOr<Solution> {
    EXPECT_EQ(number, adapted.meshing.pilots);
    SolverRun solver(patches, pilot);
    absl::Status status = solver.ToTheEnd();
    if (!status.ok()) return status;
    adapted.meshing.pilot_rays += solver.solver.MakeSnapshot().progress.rays;
    return *solver.solver.MakeSnapshot().solution;
  };
  adapted.patches = *AdaptMesh(scene, options, solve, run, &adapted.meshing);
  return adapted;
}

TEST(AdaptMesh, SplitsAtAShadowsEdgeAndNotBesideIt) {
  const Adapted adapted = Adapt(MakeShadow(), 3000);
  const PatchSet& patches = *adapted.patches;
  EXPECT_LE(patches.size(), 3000);
  EXPECT_GT(patches.size(), 500);
  EXPECT_EQ(adapted.meshing.coarse_patches, 8);
  double at_edge = 0, beside = 0, edge_area = 0, beside_area = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Vec3 p = PatchCentroid(patches, i) + patches.origin;
    if (p.z > 0.01) continue;
    const double from_edge = std::fabs(std::max(std::fabs(p.x), std::fabs(p.y)) - 1);
    (from_edge < 0.06 ? at_edge : beside) += 1;
    (from_edge < 0.06 ? edge_area : beside_area) += patches.area_m2[i];
  }
  EXPECT_GT(at_edge / edge_area, 5 * beside / beside_area) << "patches in a m2";
}

// A floor of 4 x 4 m, up is +y; a black square of 1 x 1 m hangs over its middle.
Scene MakeOutdoors(double height_m) {
  const double s = kScreen_m;
  return SceneMaker()
      .Quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, {{0.5, 0.5, 0.5}, {}})
      .Quad({-s, height_m, -s}, {0, 0, 2 * s}, {2 * s, 0, 0}, {{}, {}, true})
      .Make();
}

TEST(AdaptMesh, FollowsTheShadowOfASun) {
  PatchOptions options;
  options.lights.sun_elevation_deg = 90;
  options.lights.sun_illuminance_lx = 1000;
  // Of the patches of the floor that are both in light and in shadow.
  const auto straddling_m2 = [&](int64_t budget) {
    const Adapted adapted = Adapt(MakeOutdoors(1), budget, {}, options);
    const PatchSet& patches = *adapted.patches;
    double area_m2 = 0;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      int lit = 0, dark = 0;
      for (const Vec3& corner : patches.corners[i]) {
        const Vec3 p = corner + patches.origin;
        const double reach = std::max(std::fabs(p.x), std::fabs(p.z));
        lit += p.y < 0.5 && reach > kScreen_m + 1e-9;
        dark += p.y < 0.5 && reach < kScreen_m - 1e-9;
      }
      if (lit > 0 && dark > 0) area_m2 += patches.area_m2[i];
    }
    return area_m2;
  };
  const double coarse_m2 = straddling_m2(300);
  EXPECT_GT(coarse_m2, 0);
  EXPECT_LT(straddling_m2(3000), coarse_m2 / 2);
}

TEST(AdaptMesh, FollowsTheShadowOfASky) {
  PatchOptions options;
  options.lights.sky = "uniform";
  SolveOptions solve;
  solve.max_error = 0.005;
  const Adapted coarse = Adapt(MakeOutdoors(0.2), 200, solve, options);
  const Adapted fine = Adapt(MakeOutdoors(0.2), 1000, solve, options);
  EXPECT_GT(fine.patches->size(), coarse.patches->size());
  EXPECT_LT(fine.meshing.predicted_error, coarse.meshing.predicted_error);
}

TEST(AdaptMesh, EqualOptionsGiveEqualBytesAndOtherSeedsMayNot) {
  const Adapted once = Adapt(MakeShadow(), 1000), again = Adapt(MakeShadow(), 1000);
  EXPECT_EQ(EncodePatchSet(*once.patches), EncodePatchSet(*again.patches));
  EXPECT_EQ(once.meshing.pilot_rays, again.meshing.pilot_rays);
}

TEST(AdaptMesh, AFurnaceStaysAsItIs) {
  for (uint64_t seed : {1, 2, 3}) {
    SolveOptions solve;
    solve.seed = seed;
    const Adapted adapted = Adapt(MakeFurnace(0.5), 20000, solve);
    EXPECT_EQ(adapted.patches->size(), 12) << adapted.meshing.reason;
    EXPECT_EQ(adapted.meshing.pilots, 1);
    const PlanItem item = TellMeshing(adapted.meshing, adapted.patches->size());
    EXPECT_TRUE(item.left_out);
    EXPECT_NE(item.reason.find("no more than noise"), std::string::npos) << item.reason;
  }
}

TEST(AdaptMesh, ShootsNothingWhereNothingEmitsOrTheBudgetIsSpent) {
  const Adapted dark = Adapt(MakeBox(1, {0.5, 0.5, 0.5}, std::vector<Rgb>(6)), 1000);
  EXPECT_EQ(dark.meshing.pilots, 0);
  EXPECT_EQ(dark.meshing.reason, "nothing emits light");
  const Adapted full = Adapt(MakeShadow(), 8);
  EXPECT_EQ(full.meshing.pilots, 0);
  EXPECT_EQ(full.patches->size(), 8);
  EXPECT_TRUE(TellMeshing(full.meshing, 8).left_out);
}

TEST(AdaptMesh, PilotsKeepToAQuarterOfTheBudgets) {
  SolveOptions rays;
  rays.max_rays = 100'000;
  const Adapted adapted = Adapt(MakeShadow(), 2000, rays);
  EXPECT_GT(adapted.meshing.pilots, 0);
  EXPECT_LE(adapted.meshing.pilot_rays, rays.max_rays / 4);
  SolveOptions time;
  time.max_time_s = 0.1;
  EXPECT_LE(Adapt(MakeShadow(), 2000, time).meshing.pilot_rays, 0.1 * 5e6 / 4 * 1.02);
}

TEST(AdaptMesh, NoPilotBeginsAfterAQuarterOfTheTime) {
  PatchOptions options;
  options.adapt_patches = 50'000;
  SolveOptions solve;
  solve.max_error = 1e-6;
  solve.max_time_s = 100;
  Meshing meshing;
  const auto run = [&](const std::shared_ptr<const PatchSet>& patches, const SolveOptions& pilot,
                       int32_t) -> absl::StatusOr<Solution> {
    meshing.seconds += 10;
    SolverRun solver(patches, pilot);
    absl::Status status = solver.ToTheEnd();
    if (!status.ok()) return status;
    return *solver.solver.MakeSnapshot().solution;
  };
  ASSERT_TRUE(AdaptMesh(MakeShadow(), options, solve, run, &meshing).ok());
  EXPECT_EQ(meshing.pilots, 3);
  EXPECT_NE(meshing.reason.find("a quarter of the time of 100 s is spent"), std::string::npos)
      << meshing.reason;
}

TEST(AdaptMesh, EndsWhereTheWantedErrorIsPredicted) {
  SolveOptions rough;
  rough.max_error = 0.5;
  const Adapted adapted = Adapt(MakeShadow(), 50000, rough);
  EXPECT_LE(adapted.meshing.predicted_error, 0.5);
  EXPECT_LT(adapted.patches->size(), 5000);
  EXPECT_NE(adapted.meshing.reason.find("under the wanted 50 %"), std::string::npos)
      << adapted.meshing.reason;
}

TEST(AdaptMesh, PassesOnWhatAPilotFailsWith) {
  PatchOptions options;
  options.adapt_patches = 1000;
  Meshing meshing;
  const auto run = [](const std::shared_ptr<const PatchSet>&, const SolveOptions&,
                      int32_t) -> absl::StatusOr<Solution> { return absl::CancelledError("x"); };
  EXPECT_TRUE(absl::IsCancelled(AdaptMesh(MakeShadow(), options, {}, run, &meshing).status()));
}

TEST(AddMeshing, TellsBudgetAndPilotsOrWhyThereAreNone) {
  PatchOptions options;
  Plan plan;
  const PatchSet coarse = PatchesOf(MakeShadow());
  AddMeshing(coarse, options, plan);
  EXPECT_TRUE(plan.items.empty()) << "it is off";
  options.adapt_patches = 5000;
  AddMeshing(coarse, options, plan);
  EXPECT_FALSE(plan.items[0].left_out);
  EXPECT_NE(plan.items[0].reason.find("5000 patches"), std::string::npos) << plan.items[0].reason;
  options.adapt_patches = 8;
  AddMeshing(coarse, options, plan);
  EXPECT_TRUE(plan.items[1].left_out);
}

}  // namespace
}  // namespace lambert

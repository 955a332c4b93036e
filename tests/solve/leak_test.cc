// A lamp in a closed box inside a larger room: outside of the box it is exactly dark.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/solve/run_solver.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 100'000;
const Paint kWall{{0.7, 0.7, 0.7}, {}, true};

// The room around, and a lamp under the box's ceiling.
SceneMaker LitBoxInRoom() {
  SceneMaker maker;
  maker.Box({-5, -5, -3}, {5, 5, 5}, true, {Paint{{0.5, 0.5, 0.5}, {}}}, 1, "room");
  maker.Quad({-0.2, -0.3, 1.9}, {0, 0.4, 0}, {0.4, 0, 0}, Paint{{}, {1e3, 1e3, 1e3}}, 1, "lamp");
  return maker;
}

// Irradiance that arrives anywhere but in the box [-1, 1]^2 x [0, 2].
double LightOutside(const Scene& scene, const Cuts& cuts) {
  auto patches = std::make_shared<const PatchSet>(*BuildPatches(scene, {}, cuts));
  SolverRun run(patches, Budget(Method::kPmcr, kRays));
  EXPECT_TRUE(run.ToTheEnd().ok());
  const Solution solution = *run.solver.MakeSnapshot().solution;
  double light = 0, inside = 0;
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    // A wall's outer side counts as outside: seen from a little in front of it.
    const Vec3 p = PatchCentroid(*patches, i) + patches->origin + PatchNormal(*patches, i) * 1e-3;
    const bool is_inside = std::max(std::fabs(p.x), std::fabs(p.y)) < 1 && std::fabs(p.z - 1) < 1;
    (is_inside ? inside : light) += Mean(solution.irradiance_lx[i]);
  }
  EXPECT_GT(inside, 0);
  return light;
}

// The long edge of each wall against two short ones of the floor, which is of four squares.
Scene WithTJunctions() {
  SceneMaker maker = LitBoxInRoom();
  maker.Box({-1, -1, 0}, {1, 1, 2}, true, {kWall}, 1, "walls");
  for (double third : {-1.0, -1.0 / 3, 1.0 / 3}) {
    maker.Quad({third, -1, 0}, {2.0 / 3, 0, 0}, {0, 2, 0}, kWall, 1, "floor");
  }
  return maker.Make();
}

// Walls that pass through each other and through floor and ceiling.
Scene WithWallsThroughEachOther() {
  SceneMaker maker = LitBoxInRoom();
  for (double side : {-1.0, 1.0}) {
    maker.Quad({side, -1.4, -0.3}, {0, 2.8, 0}, {0, 0, 2.7}, kWall, 1, "wall");
    maker.Quad({-1.3, side, -0.2}, {2.6, 0, 0}, {0, 0, 2.5}, kWall, 1, "wall");
    maker.Quad({-1.5, -1.6, 1 + side}, {3, 0, 0}, {0, 3.2, 0}, kWall, 1, "floor");
  }
  return maker.Make();
}

TEST(ClosedBox, WithTJunctionsIsTight) {
  const Scene scene = WithTJunctions();
  EXPECT_EQ(LightOutside(scene, {}), 0);
  EXPECT_EQ(LightOutside(scene, FindCrossings(scene, {}, 1000)), 0);
}

TEST(ClosedBox, OfWallsThroughEachOtherIsTightOnceTheyAreCut) {
  const Scene scene = WithWallsThroughEachOther();
  EXPECT_GT(LightOutside(scene, {}), 0) << "patches carry light through the walls";
  EXPECT_EQ(LightOutside(scene, FindCrossings(scene, {}, 1000)), 0);
}

// Walls that only stand on a floor that reaches beyond them.
TEST(ClosedBox, OnAFloorThatReachesOutIsTightOnceItIsCut) {
  SceneMaker maker = LitBoxInRoom();
  maker.Box({-1, -1, 0}, {1, 1, 2}, true, {kWall, kWall, kWall, kWall, Paint{{}, {}}, kWall});
  maker.Quad({-2, -2.5, 0}, {4, 0, 0}, {0, 5, 0}, kWall, 1, "floor");
  const Scene scene = maker.Make();
  EXPECT_GT(LightOutside(scene, {}), 0) << "the floor carries light under the walls";
  EXPECT_EQ(LightOutside(scene, FindCrossings(scene, {}, 1000)), 0);
}

}  // namespace
}  // namespace lambert

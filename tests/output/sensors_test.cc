// Sensors: where they stand, what they read, and what of their files is refused.
#include "radiosity/output/sensors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <memory>

#include "radiosity/core/error.h"
#include "radiosity/gather/gather.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"
#include "tests/support/temporary_folder.h"

namespace lambert {
namespace {

class SensorFiles : public testing::Test {
 protected:
  absl::StatusOr<std::vector<SensorGrid>> Read(const std::string& name, const std::string& text) {
    const std::string path = folder_.path() + "/" + name;
    std::ofstream(path) << text;
    return ReadSensors(path);
  }
  std::string ReasonOfBad(const std::string& name, const std::string& text) {
    return ReasonOf(Read(name, text).status());
  }
  const TemporaryFolder folder_;
};

TEST(GridSpacing, IsThatOfTheNorm) {
  EXPECT_NEAR(GridSpacing(1, 1), 0.2, 1e-12);
  EXPECT_NEAR(GridSpacing(10, 6), 1, 1e-12);
  EXPECT_NEAR(GridSpacing(100, 60), 5, 1e-12);
  EXPECT_NEAR(GridSpacing(8, 10), 1, 1e-12);   // the longer side
  EXPECT_NEAR(GridSpacing(50, 10), 1, 1e-12);  // of a corridor the shorter
  EXPECT_EQ(GridSpacing(1e4, 1e4), 10);
  EXPECT_EQ(PointsAlong(10, GridSpacing(10, 10)), 10);
  EXPECT_EQ(PointsAlong(100, GridSpacing(100, 100)), 20);
  EXPECT_EQ(PointsAlong(0.1, 1), 1);
}

TEST_F(SensorFiles, AGridStandsInTheMiddlesOfItsCells) {
  const auto grids = *Read("g.json", R"({"grids": [{"name": "desk", "origin": [0, 1, 0],
      "u": [2, 0, 0], "v": [0, 0, 1], "normal": [0, 3, 0], "spacing": 0.5},
      {"origin": [0, 0, 0], "u": [0, 0, 10], "v": [10, 0, 0]}]})");
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].name, "desk");
  ASSERT_EQ(grids[0].position_m.size(), 8u);
  EXPECT_EQ(grids[0].position_m[0], (Vec3{0.25, 1, 0.25}));
  EXPECT_EQ(grids[0].position_m[7], (Vec3{1.75, 1, 0.75}));
  EXPECT_EQ(grids[0].normal[0], (Vec3{0, 1, 0}));
  EXPECT_EQ(grids[1].position_m.size(), 100u);  // 1 m apart, as the norm wants
  EXPECT_EQ(grids[1].normal[0], (Vec3{0, 1, 0}));
}

TEST_F(SensorFiles, PointsAreReadByTheirColumns) {
  const auto grids = *Read("p.csv", "z,y,x,grid,nx,ny,nz\r\n3,2,1,b,0,0,-2\n6,5,4,a,1,0,0\n");
  ASSERT_EQ(grids.size(), 2u);
  EXPECT_EQ(grids[0].name, "a");
  EXPECT_EQ(grids[1].position_m[0], (Vec3{1, 2, 3}));
  EXPECT_EQ(grids[1].normal[0], (Vec3{0, 0, -1}));
  const auto bare = *Read("q.csv", "x,y,z\n1,2,3\n\n");
  ASSERT_EQ(bare[0].position_m.size(), 1u);
  EXPECT_EQ(bare[0].normal[0], (Vec3{0, 1, 0}));  // up
}

TEST_F(SensorFiles, WhatIsWrongIsOneError) {
  for (const char* bad : {"x,y\n1,2\n", "x,y,z\n", "x,y,z\n1,2\n", "x,y,z\n1,2,fog\n",
                          "x,y,z\n1,2,inf\n", "x,y,z,nx,ny,nz\n1,2,3,0,0,0\n", ""}) {
    EXPECT_EQ(ReasonOfBad("bad.csv", bad), "SENSORS_INVALID") << bad;
  }
  const std::string sides = R"("origin": [0,0,0], "u": [1,0,0], "v": [0,0,1])";
  for (const std::string& grid :
       {std::string("3"), std::string("{}"), "{" + sides + R"(, "normal": 1})",
        "{" + sides + R"(, "normal": [0,0,0]})", "{" + sides + R"(, "spacing": 0})",
        "{" + sides + R"(, "spacing": "1"})", "{" + sides + R"(, "spacing": 1e-9})",
        std::string(R"({"origin": [0,0,0], "u": [1,0,0], "v": [2,0,0]})")}) {
    EXPECT_EQ(ReasonOfBad("bad.json", R"({"grids": [)" + grid + "]}"), "SENSORS_INVALID") << grid;
  }
  EXPECT_EQ(ReasonOfBad("bad.json", "[]"), "SENSORS_INVALID");
  EXPECT_EQ(ReasonOfBad("bad.json", R"({"grids": []})"), "SENSORS_INVALID");
  EXPECT_EQ(ReasonOf(ReadSensors("/nowhere.json").status()), "FILE_NOT_FOUND");
}

// Two rooms on two floors, a table in one.
PatchSet TwoStoreys() {
  const Paint paint{{0.5, 0.5, 0.5}, {0, 0, 0}};
  SceneMaker maker;
  maker.Box({0, 0, 0}, {6, 3, 4}, true, {paint}, 2).Box({0, 3.2, 0}, {6, 6, 4}, true, {paint}, 2);
  maker.Box({2, 0, 1}, {4, 0.7, 3}, false, {paint});
  return PatchesOf(maker.Make());
}

TEST(WorkPlane, StandsOverEachFloorAndLeavesOutTheWallZone) {
  const PatchSet patches = TwoStoreys();
  const auto planes = *WorkPlanes(patches, 0.8);
  ASSERT_EQ(planes.size(), 2u);
  const double spacing = GridSpacing(5, 3);
  for (size_t k = 0; k < 2; ++k) {
    ASSERT_EQ(planes[k].position_m.size(),
              static_cast<size_t>(PointsAlong(5, spacing) * PointsAlong(3, spacing)));
    for (const Vec3& at : planes[k].position_m) {
      EXPECT_NEAR(at.y, k == 0 ? 0.8 : 4, 1e-6);
      EXPECT_GT(at.x, 0.5);
      EXPECT_LT(at.x, 5.5);
      EXPECT_GT(at.z, 0.5);
      EXPECT_LT(at.z, 3.5);
    }
  }
  const auto none = WorkPlanes(PatchesOf(MakeParallelSquares(0, 0)), 0.8);
  EXPECT_EQ(ReasonOf(none.status()), "SENSORS_INVALID");
}

TEST(Sensors, ReadAFurnaceAndTellWhatStandsInASolid) {
  const Paint glow{{0.5, 0.5, 0.5}, {1, 1, 1}};  // E = B = 1 / (1 - .5) everywhere
  SceneMaker maker;
  maker.Box({0, 0, 0}, {4, 3, 4}, true, {glow}).Box({1, 0, 1}, {2, 1, 2}, false, {glow});
  const auto patches = std::make_shared<const PatchSet>(PatchesOf(maker.Make()));
  const std::vector<Rgb> radiosity(patches->size(), Rgb{2, 2, 2});
  std::vector<SensorGrid> grids(1);
  grids[0].name = "a, \"grid\"";
  for (const Vec3& at : {Vec3{3, 1, 3}, Vec3{1.5, 0.5, 1.5}, Vec3{0.4, 2, 0.6}}) {
    grids[0].position_m.push_back(at);
    grids[0].normal.push_back(Normalized(Vec3{1, 2, 3}));
  }
  SampleMean means[3];
  for (uint64_t seed = 1; seed <= 32; ++seed) {
    const auto gather = *GatherHere(patches, radiosity, {256, seed});
    ASSERT_TRUE(GatherSensors(*patches, gather, grids).ok());
    for (int i = 0; i < 3; ++i) means[i].Add(grids[0].irradiance_lx[i].g);
  }
  EXPECT_EQ(grids[0].is_inside, (std::vector<bool>{false, true, false}));
  for (size_t i : {0u, 2u}) {
    EXPECT_NEAR(means[i].mean(), 2, kSigmas * means[i].std_error() + 1e-6);
    EXPECT_LT(means[i].std_error(), 0.01);
  }
  const GridFigures figures = FiguresOf(grids[0]);
  EXPECT_EQ(figures.sensors, 3);
  EXPECT_EQ(figures.inside, 1);
  EXPECT_NEAR(figures.mean_lx, 2, 0.1);
  EXPECT_NEAR(figures.uniformity, 1, 0.1);
  const std::string csv = EncodeSensorsCsv(grids);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 4);
  EXPECT_NE(csv.find("\na grid,1,1.5,0.5,1.5,"), std::string::npos);
  EXPECT_NE(EncodeSensorsJson(grids).find("\"uniformity_u0\""), std::string::npos);
}

TEST(Sensors, UniformityIsLeastOverMean) {
  SensorGrid grid;
  for (double lx : {1.0, 2.0, 3.0, 100.0}) {
    grid.position_m.push_back({});
    grid.irradiance_lx.push_back({lx, lx, lx});
    grid.is_inside.push_back(lx == 100);
  }
  const GridFigures figures = FiguresOf(grid);
  EXPECT_NEAR(figures.mean_lx, 2, 1e-12);
  EXPECT_NEAR(figures.min_lx, 1, 1e-12);
  EXPECT_NEAR(figures.max_lx, 3, 1e-12);
  EXPECT_NEAR(figures.uniformity, 0.5, 1e-12);
  grid.is_inside.assign(4, true);
  EXPECT_EQ(FiguresOf(grid).mean_lx, 0);
}

}  // namespace
}  // namespace lambert

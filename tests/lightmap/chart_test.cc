#include "radiosity/lightmap/chart.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "radiosity/patch/place.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

std::vector<SurfaceTriangle> SurfaceOf(const Scene& scene) {
  std::vector<SurfaceTriangle> surface;
  EXPECT_TRUE(ForEachTriangle(scene, {}, [&surface](const PlacedTriangle& placed) {
                surface.push_back({placed.corners, placed.vertices, true});
                return absl::OkStatus();
              }).ok());
  return surface;
}

double Area(const FlatTriangle& t) {
  return std::fabs((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) -
                   (t[1][1] - t[0][1]) * (t[2][0] - t[0][0])) /
         2;
}

// Every triangle once, no overlap, areas within the cosine of the chart angle.
void ExpectSound(const std::vector<Chart>& charts, const std::vector<SurfaceTriangle>& surface) {
  std::set<int32_t> seen;
  for (const Chart& chart : charts) {
    EXPECT_FALSE(Overlap(chart.flat_m));
    for (size_t i = 0; i < chart.triangles.size(); ++i) {
      EXPECT_TRUE(seen.insert(chart.triangles[i]).second);
      const auto& [a, b, c] = surface[chart.triangles[i]].corners;
      const double area = Length(Cross(b - a, c - a)) / 2;
      EXPECT_LE(Area(chart.flat_m[i]), area * 1.001);
      EXPECT_GE(Area(chart.flat_m[i]), area * 0.866 * 0.999);
    }
  }
  EXPECT_EQ(seen.size(), surface.size());
}

const Paint kWhite{{0.5, 0.5, 0.5}, {}};

TEST(ChartsByNormal, APlaneIsOneChartOfItsOwnSize) {
  // Turned about every axis: the rectangle around it is found again.
  const Vec3 u = Normalized(Vec3{1, 2, 2}) * 3, v = Normalized(Vec3{2, 1, -2}) * 2;
  const auto surface = SurfaceOf(SceneMaker().Quad({5, 6, 7}, u, v, kWhite, 4).Make());
  const std::vector<Chart> charts = ChartsByNormal(surface);
  ASSERT_EQ(charts.size(), 1u);
  ExpectSound(charts, surface);
  EXPECT_NEAR(charts[0].size_m[0] * charts[0].size_m[1], 6, 1e-5);
}

TEST(ChartsByNormal, ASphereIsCutIntoFewerChartsThanTriangles) {
  const auto surface = SurfaceOf(MakeIcosphere(3, kWhite));
  const std::vector<Chart> charts = ChartsByNormal(surface);
  ExpectSound(charts, surface);
  EXPECT_GE(charts.size(), 8u);
  EXPECT_LE(charts.size(), 80u);
}

// A winding stair whose second turn lies over the first in projection.
TEST(ChartsByNormal, WhatOverlapsItselfInProjectionIsTakenApart) {
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, kWhite).Make();
  Primitive& ramp = scene.meshes[0].primitives[0];
  ramp.positions.clear();
  ramp.triangles.clear();
  for (uint32_t i = 0; i < 33; ++i) {
    const double angle = i * M_PI / 8;
    for (double radius : {1.0, 2.0}) {
      ramp.positions.push_back({static_cast<float>(radius * std::cos(angle)),
                                static_cast<float>(radius * std::sin(angle)), 0.02f * i});
    }
    if (i > 0) {
      ramp.triangles.push_back({2 * i - 2, 2 * i - 1, 2 * i});
      ramp.triangles.push_back({2 * i - 1, 2 * i + 1, 2 * i});
    }
  }
  const auto surface = SurfaceOf(scene);
  const std::vector<Chart> charts = ChartsByNormal(surface);
  EXPECT_EQ(charts.size(), surface.size());
  ExpectSound(charts, surface);
}

TEST(ChartsByNormal, TrianglesWithoutAreaAreLeftOut) {
  auto surface = SurfaceOf(SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, kWhite).Make());
  surface.push_back({{Vec3{1, 1, 1}, Vec3{1, 1, 1}, Vec3{1, 1, 1}}, {0, 0, 0}, false});
  const std::vector<Chart> charts = ChartsByNormal(surface);
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_EQ(charts[0].triangles, (std::vector<int32_t>{0, 1}));
}

class Uvs : public ::testing::Test {
 protected:
  // Two triangles of a square of 2 m x 1 m, with corner coordinates as given.
  Uvs() {
    surface = {{{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 1, 0}}, {0, 1, 2}, true},
               {{Vec3{0, 0, 0}, Vec3{2, 1, 0}, Vec3{0, 1, 0}}, {3, 4, 5}, true}};
  }
  std::vector<SurfaceTriangle> surface;
};

TEST_F(Uvs, OneIslandKeepsItsShapeInMetres) {
  const std::vector<Chart> charts =
      ChartsOfUv(surface, {{0, 0}, {.5, 0}, {.5, .5}, {0, 0}, {.5, .5}, {0, .5}});
  ASSERT_EQ(charts.size(), 1u);
  EXPECT_NEAR(charts[0].size_m[0], 2, 1e-6);
  EXPECT_NEAR(charts[0].size_m[1], 1, 1e-6);
}

TEST_F(Uvs, IslandsAreChartsOfTheirOwn) {
  const std::vector<Chart> charts =
      ChartsOfUv(surface, {{0, 0}, {.4f, 0}, {.4f, .4f}, {.5, .5}, {1, 1}, {.5, 1}});
  ASSERT_EQ(charts.size(), 2u);
  ExpectSound(charts, surface);
}

TEST_F(Uvs, WhatIsNotUniqueIsNotKept) {
  EXPECT_TRUE(ChartsOfUv(surface, {}).empty());
  // The same place twice.
  EXPECT_TRUE(ChartsOfUv(surface, {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {1, 0}}).empty());
  // Repeated.
  EXPECT_TRUE(ChartsOfUv(surface, {{0, 0}, {2, 0}, {2, 2}, {0, 0}, {2, 2}, {0, 2}}).empty());
  // A line.
  EXPECT_TRUE(ChartsOfUv(surface, {{0, 0}, {1, 0}, {.5, 0}, {0, 0}, {1, 1}, {0, 1}}).empty());
  const float nan = std::nanf("");
  EXPECT_TRUE(ChartsOfUv(surface, {{0, 0}, {nan, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}).empty());
}

}  // namespace
}  // namespace lambert

#include "radiosity/output/smooth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr Paint kGray{{0.5, 0.5, 0.5}, {}};

using CornerValues = std::vector<std::array<Rgb, 3>>;

CornerValues Smoothed(const PatchSet& patches, const std::function<double(Vec3)>& irradiance_lx) {
  const auto scene = RayScene::Create(patches);
  EXPECT_TRUE(scene.ok());
  std::vector<Rgb> values;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const double value = irradiance_lx(patches.origin + PatchCentroid(patches, i));
    values.push_back({value, value, value});
  }
  return SmoothIrradiance(patches, FindCornerFans(patches, **scene), values);
}

// The floor 0..4 x 0..4 of 8 x 8 squares, facing up, and what stands on it.
SceneMaker Floor() { return SceneMaker().Quad({}, {0, 0, 4}, {4, 0, 0}, kGray, 8, "floor"); }

bool OnFloor(const PatchSet& patches, PatchIndex i) {
  return patches.node_names[patches.source[i].node] == "floor";
}

// Share of the area of patch i outside of low .. high, seen from above, on a fine grid of points.
double ShareOutside(const PatchSet& patches, PatchIndex i, Vec3 low, Vec3 high) {
  constexpr int kFine = 60;
  const auto& c = patches.corners[i];
  int points = 0, outside = 0;
  for (int a = 0; a < kFine; ++a) {
    for (int b = 0; a + b < kFine; ++b, ++points) {
      const double u = (a + 1.0 / 3) / kFine, v = (b + 1.0 / 3) / kFine;
      const Vec3 p = patches.origin + c[0] + (c[1] - c[0]) * u + (c[2] - c[0]) * v;
      outside += p.x < low.x || p.x > high.x || p.z < low.z || p.z > high.z;
    }
  }
  return static_cast<double>(outside) / points;
}

TEST(SmoothIrradiance, CornersOfOneSurfaceThatMeetShareOneValue) {
  const PatchSet patches = PatchesOf(Floor().Make());
  const CornerValues light = Smoothed(patches, [](Vec3 p) { return 1 + p.x * p.z; });
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (PatchIndex j = 0; j < patches.size(); ++j) {
      for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
          if (patches.corners[i][a] == patches.corners[j][b]) {
            ASSERT_EQ(light[i][a], light[j][b]);
          }
        }
      }
    }
  }
}

TEST(SmoothIrradiance, ALinearFieldIsReproducedInsideAnEvenGrid) {
  const PatchSet patches = PatchesOf(Floor().Make());
  const CornerValues light = Smoothed(patches, [](Vec3 p) { return 1 + 2 * p.x; });
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 p = patches.origin + patches.corners[i][corner];
      const bool outer = p.x < 0.1 || p.x > 3.9 || p.z < 0.1 || p.z > 3.9;
      if (outer) continue;
      // The six triangles around a grid point balance each other.
      EXPECT_NEAR(light[i][corner].g, 1 + 2 * p.x, 1e-6);
    }
  }
}

TEST(SmoothIrradiance, TheEdgesOfARoomStaySharp) {
  const PatchSet patches = PatchesOf(MakeFurnace(0.5, 1, 4));
  // Lit by the height alone: every wall is .5, the floor 0, the ceiling 1.
  auto light_of = [](Vec3 p) { return p.y < 1e-3 ? 0.0 : p.y > 1 - 1e-3 ? 1.0 : 0.5; };
  const CornerValues light = Smoothed(patches, light_of);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const double own = light_of(patches.origin + PatchCentroid(patches, i));
    for (int corner = 0; corner < 3; ++corner) EXPECT_EQ(light[i][corner].r, own);
  }
}

TEST(SmoothIrradiance, ARoundSurfaceIsSmooth) {
  // Normals of neighbours on the 320-faced sphere turn by less than 20 degrees.
  const PatchSet patches = PatchesOf(MakeIcosphere(2, kGray));
  const auto scene = RayScene::Create(patches);
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(FindCornerFans(patches, **scene).fan_count, 162);  // the vertices of the sphere
}

TEST(SmoothIrradiance, NothingLeaksUnderAPartition) {
  // One side is lit, the other dark; the wall stands on x = 2, with no vertex in the floor's mesh
  // and a one-sided face to each side.
  for (double x : {2.0, 2.03}) {
    const PatchSet patches =
        PatchesOf(Floor()
                      .Quad({x, 0, -1}, {0, 2, 0}, {0, 0, 6}, kGray, 1, "wall")
                      .Quad({x, 0, -1}, {0, 0, 6}, {0, 2, 0}, kGray, 1, "other side")
                      .Make());
    auto light_of = [&](Vec3 p) { return p.x < x ? 1.0 : 0.01; };
    const CornerValues light = Smoothed(patches, light_of);
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      if (!OnFloor(patches, i)) continue;
      const double own = light_of(patches.origin + PatchCentroid(patches, i));
      for (int corner = 0; corner < 3; ++corner) {
        EXPECT_EQ(light[i][corner].r, own) << "wall at " << x;
      }
    }
  }
}

TEST(SmoothIrradiance, AOneSidedPartitionPartsTheFloorToo) {
  for (bool faces_left : {true, false}) {
    const Vec3 along{0, 0, 6}, up{0, 2, 0};
    const PatchSet patches = PatchesOf(
        Floor()
            .Quad({2, 0, -1}, faces_left ? along : up, faces_left ? up : along, kGray, 1, "wall")
            .Make());
    const CornerValues light = Smoothed(patches, [](Vec3 p) { return p.x < 2 ? 1.0 : 0.0; });
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      if (!OnFloor(patches, i)) continue;
      const double own = (patches.origin + PatchCentroid(patches, i)).x < 2 ? 1.0 : 0.0;
      for (int corner = 0; corner < 3; ++corner) EXPECT_EQ(light[i][corner].r, own);
    }
  }
}

TEST(SmoothIrradiance, NoDarkCrumbsShowAroundFurniture) {
  // An even light of 1 lx, but none under the box on 1.13 .. 2.37: a patch that it covers in part
  // receives what falls on the rest.
  const Vec3 low{1.13, 0, 1.13}, high{2.37, 1, 2.37};
  const PatchSet patches = PatchesOf(Floor().Box(low, high, false, {kGray}, 1, "box").Make());
  const auto scene = RayScene::Create(patches);
  ASSERT_TRUE(scene.ok());
  const CornerFans fans = FindCornerFans(patches, **scene);
  std::vector<Rgb> received;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const double share = ShareOutside(patches, i, low, high);
    received.push_back({share, share, share});
  }
  const CornerValues light = SmoothIrradiance(patches, fans, received);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!OnFloor(patches, i) || received[i].r == 0) continue;
    // The exposed share is counted on 16 points; where fewer than 3 are free the count is rough.
    if (fans.survey[i].exposed_share < 0.2) continue;
    for (const Rgb& corner : light[i]) EXPECT_NEAR(corner.r, 1, 0.25) << "patch " << i;
  }
}

TEST(SmoothIrradiance, BothSidesOfATwoSidedSheetKeepTheirOwnLight) {
  const PatchSet patches =
      PatchesOf(SceneMaker().Quad({}, {0, 0, 4}, {4, 0, 0}, {{0.5, 0.5, 0.5}, {}, true}, 4).Make());
  const auto scene = RayScene::Create(patches);
  ASSERT_TRUE(scene.ok());
  std::vector<Rgb> light;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    light.push_back(patches.is_back[i] ? Rgb{} : Rgb{1, 1, 1});
  }
  const CornerValues smooth = SmoothIrradiance(patches, FindCornerFans(patches, **scene), light);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (const Rgb& corner : smooth[i]) EXPECT_EQ(corner, light[i]);
  }
}

TEST(SmoothIrradiance, NeverLeavesTheRangeOfThePatches) {
  const PatchSet patches = PatchesOf(MakeFurnace(0.5, 1, 4));
  const CornerValues light =
      Smoothed(patches, [](Vec3 p) { return 2 + std::sin(9 * p.x) * std::cos(7 * p.z); });
  for (const auto& corners : light) {
    for (const Rgb& value : corners) {
      EXPECT_GE(value.r, 1 - 1e-12);
      EXPECT_LE(value.r, 3 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace lambert

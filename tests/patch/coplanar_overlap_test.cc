#include "radiosity/patch/coplanar_overlap.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

const Paint kGray{{0.5, 0.5, 0.5}, {1, 1, 1}};

// A floor of 2 n^2 patches in z = 0 that faces up, and on it what a test puts there.
SceneMaker Floor(int n = 1, const Paint& paint = kGray) {
  return SceneMaker().Quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, paint, n, "floor");
}

int64_t CountIn(const SceneMaker& maker) {
  return FindCoplanarOverlaps(PatchesOf(maker.Make())).patches;
}

TEST(CoplanarOverlap, ARugInThePlaneOfTheFloorIsFound) {
  const PatchSet patches =
      PatchesOf(Floor().Quad({0.2, 0.2, 0}, {0.6, 0, 0}, {0, 0.6, 0}, kGray, 1, "rug").Make());
  const CoplanarOverlaps found = FindCoplanarOverlaps(patches);
  EXPECT_EQ(found.patches, 4);
  EXPECT_EQ(patches.source[found.first].node + patches.source[found.other].node, 1);
  EXPECT_LT(found.first, found.other);
  EXPECT_EQ(patches.warnings.at(0).reason, "COPLANAR_OVERLAP");
  EXPECT_NE(patches.warnings[0].message.find("\"rug\""), std::string::npos);
  EXPECT_NE(patches.warnings[0].message.find("\"floor\""), std::string::npos);
}

TEST(CoplanarOverlap, OnlyPatchesUnderTheRugAreCounted) {
  // Of 20 x 20 squares of two patches the rug's lower left corner lies over half of one square.
  EXPECT_EQ(CountIn(Floor(20).Quad({0.1, 0.1, 0}, {0.05, 0, 0}, {0, 0.05, 0}, kGray)), 0)
      << "the same square, exactly: a duplicate";
  EXPECT_EQ(CountIn(Floor(20).Quad({0.1, 0.1, 0}, {0, -0.05, 0}, {0.05, 0, 0}, kGray)), 4)
      << "a square cut along the other diagonal";
  EXPECT_EQ(CountIn(Floor(20).Quad({0.11, 0.11, 0}, {0.03, 0, 0}, {0, 0.03, 0}, kGray)), 4);
}

TEST(CoplanarOverlap, BacksMeetNothingUnlessTwoSided) {
  const Paint two_sided{{0.5, 0.5, 0.5}, {}, true};
  const auto with_back = [](const Paint& floor, const Paint& rug) {
    return CountIn(Floor(1, floor).Quad({0.2, 0.2, 0}, {0, 0.6, 0}, {0.6, 0, 0}, rug));
  };
  EXPECT_EQ(with_back(kGray, kGray), 0) << "back to back";
  EXPECT_EQ(with_back(two_sided, kGray), 4);
  EXPECT_EQ(with_back(kGray, two_sided), 4);
  EXPECT_EQ(with_back(two_sided, two_sided), 8);
}

TEST(CoplanarOverlap, NeighboursAndNearPlanesMeetNothing) {
  EXPECT_EQ(CountIn(Floor(7).Quad({1, 0, 0}, {1, 0, 0}, {0, 1, 0}, kGray, 5)), 0) << "T-junctions";
  EXPECT_EQ(CountIn(Floor().Quad({0.2, 0.2, 0x1p-23}, {0.6, 0, 0}, {0, 0.6, 0}, kGray)), 0);
  for (const Scene& scene :
       {MakeOffice(2), MakeCornell(3), MakeIcosphere(3, kGray), MakeLShapedFurnace(0.5, 1, 2)}) {
    EXPECT_EQ(FindCoplanarOverlaps(PatchesOf(scene)).patches, 0);
  }
}

TEST(CoplanarOverlap, WhatIsTooSmallForANormalMeetsNothing) {
  // Beside 1e17 m the corners of the floor are one point.
  EXPECT_EQ(CountIn(Floor().Quad({0, 0, 0}, {1e17, 0, 0}, {0, 1e17, 0}, kGray)), 0);
  EXPECT_EQ(CountIn(Floor().Quad({0, 0, 1}, {1e17, 0, 0}, {0, 1e17, 0}, kGray)), 0);
}

TEST(CoplanarOverlap, TheOriginMayBeFarAway) {
  PatchSet patches =
      PatchesOf(Floor().Quad({0.2, 0.2, 0}, {0.6, 0, 0}, {0, 0.6, 0}, kGray, 1, "rug").Make());
  for (auto& corners : patches.corners) {
    for (Vec3& p : corners) p = p + Vec3{-0x1p20, 0x1p20, 0x1p20};
  }
  EXPECT_EQ(FindCoplanarOverlaps(patches).patches, 4);
}

// Corners are rounded to float32 after they are turned, as exporters do.
TEST(CoplanarOverlap, RugsAreFoundAndNeighboursAreNotHoweverTheSceneIsTurnedAndScaled) {
  std::mt19937 random(2);
  std::normal_distribution<double> gauss;
  for (int k = 0; k < 200; ++k) {
    const auto vector = [&] { return Vec3{gauss(random), gauss(random), gauss(random)}; };
    const double scale = std::exp(8 * gauss(random));
    const Vec3 z = Normalized(vector()), x = Normalized(Cross(z, vector())), y = Cross(z, x);
    const Vec3 origin = vector() * (0.2 * scale);
    const Vec3 u = x * scale, v = y * scale;
    SceneMaker maker;
    maker.Quad(origin, u, v, kGray, 3).Quad(origin + u, v, v * -1 + z * scale, kGray, 3);
    EXPECT_EQ(CountIn(maker), 0) << k;
    maker.Quad(origin + u * 0.4 + v * 0.4, u * 0.05, v * 0.05, kGray);
    EXPECT_EQ(CountIn(maker), 4) << k;
  }
}

}  // namespace
}  // namespace lambert

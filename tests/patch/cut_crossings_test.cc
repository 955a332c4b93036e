#include "radiosity/patch/cut_crossings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/patch/build_patches.h"
#include "radiosity/patch/crossing.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

using Triangle = std::array<Vec3, 3>;

constexpr int64_t kMost = 1000;

// A floor of 4 x 4 m at height 0.
const std::vector<Triangle> kFloor = {{Vec3{-2, -2, 0}, Vec3{2, -2, 0}, Vec3{2, 2, 0}},
                                      {Vec3{-2, -2, 0}, Vec3{2, 2, 0}, Vec3{-2, 2, 0}}};

// The floor and an upright square wall at x = .3 from y = from to y = to and from height `low` up.
std::vector<Triangle> WithWall(double from, double to, double low) {
  std::vector<Triangle> all = kFloor;
  const Vec3 a{0.3, from, low}, b{0.3, to, low}, c{0.3, to, 1}, d{0.3, from, 1};
  all.push_back({a, b, c});
  all.push_back({a, c, d});
  return all;
}

double AreaOf(const std::vector<SplitPiece>& pieces) {
  double area = 0;
  for (const SplitPiece& piece : pieces) {
    const Vec3 a = piece[0].position;
    const Vec3 twice = Cross(piece[1].position - a, piece[2].position - a);
    EXPECT_GT(twice.z, 0) << "wound like the whole";
    area += twice.z / 2;
    for (const SplitCorner& corner : piece) {
      const Vec3 w = corner.barycentric;
      EXPECT_NEAR(w.x + w.y + w.z, 1, 1e-12);
    }
  }
  return area;
}

// Pieces of the floor that have points on both sides of the wall, where it stands.
int Straddling(const std::map<int64_t, std::vector<SplitPiece>>& cut, double from, double to) {
  int count = 0;
  for (int64_t number : {0, 1}) {
    const auto found = cut.find(number);
    const std::vector<SplitPiece> pieces =
        found == cut.end() ? std::vector{WholePiece(kFloor[number])} : found->second;
    for (const SplitPiece& piece : pieces) {
      const Segment3 wall{{0.3, from, 0}, {0.3, to, 0}};
      const Triangle corners = {piece[0].position, piece[1].position, piece[2].position};
      count += InsidePart(wall, corners, {0, 0, 1}, 1e-5).has_value();
    }
  }
  return count;
}

TEST(CutCrossings, AWallThatPassesThroughOrStandsOnTheFloorCutsIt) {
  for (double low : {-0.5, 0.0, 1e-7}) {
    const auto cut = CutCrossings(WithWall(-1, 1.2, low), kMost);
    ASSERT_TRUE(cut.contains(0) && cut.contains(1)) << low;
    EXPECT_NEAR(AreaOf(cut.at(0)), 8, 1e-9);
    EXPECT_NEAR(AreaOf(cut.at(1)), 8, 1e-9);
    EXPECT_EQ(Straddling(cut, -1, 1.2), 0);
  }
}

TEST(CutCrossings, AWallBesideOrAboveTheFloorCutsNothing) {
  EXPECT_TRUE(CutCrossings(WithWall(-1, 1, 0.01), kMost).empty());
  EXPECT_TRUE(CutCrossings(WithWall(3, 4, -1), kMost).empty());
  EXPECT_TRUE(CutCrossings(kFloor, kMost).empty()) << "neighbours meet at their edge alone";
  EXPECT_TRUE(CutCrossings({}, kMost).empty());
}

// Both triangles of the floor get the point where the wall passes their common edge.
TEST(CutCrossings, NeighboursAreCutAtTheSamePointsOfTheirEdge) {
  const auto cut = CutCrossings(WithWall(-1, 1.2, -0.5), kMost);
  const auto on_diagonal = [&](int64_t number) {
    std::vector<Vec3> points;
    for (const SplitPiece& piece : cut.at(number)) {
      for (const SplitCorner& corner : piece) {
        const Vec3 p = corner.position;
        if (std::fabs(p.x - p.y) < 1e-12 && std::fabs(p.x) < 1.9) points.push_back(p);
      }
    }
    return points;
  };
  ASSERT_FALSE(on_diagonal(0).empty());
  for (const Vec3& p : on_diagonal(0)) EXPECT_EQ(p, on_diagonal(1).front());
  EXPECT_NEAR(on_diagonal(0).front().x, 0.3, 1e-12);
}

// Nor does a corner that only lies on an edge (T-junction): no light passes there.
TEST(CutCrossings, ACornerOnAnEdgeCutsNothing) {
  std::vector<Triangle> all = kFloor;
  all.push_back({Vec3{0.5, -2, 0}, Vec3{0.5, -3, 0}, Vec3{2, -2, 0}});
  EXPECT_TRUE(CutCrossings(all, kMost).empty());
}

TEST(CutCrossings, TheLargestAreCutUntilThereAreEnoughPieces) {
  std::vector<Triangle> all = WithWall(-1, 1.2, -0.5);
  for (Vec3& p : all[1]) p = p * 0.99;  // smaller, and still crossed
  EXPECT_TRUE(CutCrossings(all, 0).empty());
  const auto cut = CutCrossings(all, 1);
  EXPECT_TRUE(cut.contains(0));
  EXPECT_FALSE(cut.contains(1));
}

TEST(CutCrossings, TrianglesWithoutAreaCutNothing) {
  std::vector<Triangle> all = kFloor;
  all.push_back({Vec3{0, 0, -1}, Vec3{0, 0, 0}, Vec3{0, 0, 1}});
  EXPECT_TRUE(CutCrossings(all, kMost).empty());
}

TEST(FindCrossings, OfASceneAreCutByBuildPatchesAndCounted) {
  const Paint paint{{0.5, 0.5, 0.5}, {1, 1, 1}};
  const Scene scene = SceneMaker()
                          .Quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, paint)
                          .Box({-1, -1, -0.5}, {1, 1, 1}, false, {paint})
                          .Make();
  const Cuts cuts = FindCrossings(scene, {}, 1000);
  const PatchSet plain = PatchesOf(scene), cut = *BuildPatches(scene, {}, cuts);
  EXPECT_GT(cut.size(), plain.size() + 8);
  double before = 0, after = 0;
  for (double area : plain.area_m2) before += area;
  for (double area : cut.area_m2) after += area;
  EXPECT_NEAR(after, before, 1e-9);
  EXPECT_EQ(cut.warnings.front().reason, "CROSSING_PATCHES");
  // No piece of the floor is both under the box and beside it.
  for (PatchIndex i = 0; i < cut.size(); ++i) {
    if (cut.source[i].node != 0) continue;
    int inside = 0, outside = 0;
    for (const Vec3& corner : cut.corners[i]) {
      const Vec3 p = corner + cut.origin;
      const double reach = std::max(std::fabs(p.x), std::fabs(p.y));
      inside += reach < 1 - 1e-6;
      outside += reach > 1 + 1e-6;
    }
    EXPECT_TRUE(inside == 0 || outside == 0);
  }
}

TEST(FindCrossings, WhatIsLeftOutCutsNothing) {
  const Paint paint{{0.5, 0.5, 0.5}, {1, 1, 1}};
  Scene scene = SceneMaker()
                    .Quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, paint)
                    .Quad({0.3, -1, -1}, {0, 2, 0}, {0, 0, 2}, {{0.4, 0.4, 0.4}, {}})
                    .Make();
  const int floor = scene.meshes[0].primitives[0].material;
  for (int i = 0; i < static_cast<int>(scene.materials.size()); ++i) {
    scene.materials[i].blend = i != floor;
  }
  EXPECT_FALSE(FindCrossings(scene, {}, kMost).crossed.empty());
  PatchOptions omit;
  omit.blend = Blend::kOmit;
  EXPECT_TRUE(FindCrossings(scene, omit, kMost).crossed.empty());
}

}  // namespace
}  // namespace lambert

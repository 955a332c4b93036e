#include "radiosity/patch/edge_marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numbers>
#include <tuple>

#include "radiosity/patch/build_patches.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

using Point = std::tuple<double, double, double>;

// Edges that are not those of just two patches, the other way round: none where a closed mesh has
// no T-junction.
int OpenEdges(const PatchSet& patches) {
  std::map<std::pair<Point, Point>, int> sides;
  const auto key = [](Vec3 p) { return Point(p.x, p.y, p.z); };
  for (const auto& corners : patches.corners) {
    for (int k = 0; k < 3; ++k) ++sides[{key(corners[k]), key(corners[(k + 1) % 3])}];
  }
  int open = 0;
  for (const auto& [side, count] : sides) {
    const auto other = sides.find({side.second, side.first});
    open += count != 1 || other == sides.end();
  }
  return open;
}

double LeastAngle(const PatchSet& patches) {
  double least = std::numbers::pi;
  for (const auto& corners : patches.corners) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = corners[(k + 1) % 3] - corners[k], b = corners[(k + 2) % 3] - corners[k];
      least = std::min(least, std::atan2(Length(Cross(a, b)), Dot(a, b)));
    }
  }
  return least;
}

double Area(const PatchSet& patches) {
  double area = 0;
  for (double a : patches.area_m2) area += a;
  return area;
}

TEST(EdgeMarks, KnowEdgesByTheirEndsInEitherOrder) {
  EdgeMarks marks;
  EXPECT_TRUE(marks.empty());
  EXPECT_TRUE(marks.Add({0, 0, 1}, {1, 2, 3}));
  EXPECT_FALSE(marks.Add({1, 2, 3}, {0, 0, 1}));
  EXPECT_TRUE(marks.Has({1, 2, 3}, {-0.0, 0, 1})) << "both zeros are one number";
  EXPECT_FALSE(marks.Has({1, 2, 3}, {0, 1, 0}));
}

TEST(MarkPatches, TenLevelsAtOnePlaceLeaveNoTJunctionAndNoSliver) {
  const Scene scene = MakeBox(1, {0.5, 0.5, 0.5}, std::vector<Rgb>(6));
  Cuts cuts;
  const double angle = LeastAngle(PatchesOf(scene)), area = Area(PatchesOf(scene));
  for (int level = 0; level < 10; ++level) {
    const PatchSet patches = *BuildPatches(scene, {}, cuts);
    // The patch nearest to a point of no symmetry.
    const auto distance = [&](PatchIndex i) {
      return Length(PatchCentroid(patches, i) + patches.origin - Vec3{0.317, 0.229, 0});
    };
    PatchIndex nearest = 0;
    for (PatchIndex i = 1; i < patches.size(); ++i) {
      if (distance(i) < distance(nearest)) nearest = i;
    }
    cuts.levels.push_back(MarkPatches(patches, {nearest}));
    const PatchSet finer = *BuildPatches(scene, {}, cuts);
    EXPECT_EQ(finer.size(), CountHalved(patches, cuts.levels.back()));
    EXPECT_GE(finer.size(), patches.size() + 3);
    EXPECT_EQ(OpenEdges(finer), 0) << level;
    EXPECT_NEAR(Area(finer), area, 1e-12);
    EXPECT_GT(LeastAngle(finer), 0.49 * angle) << level;
  }
  EXPECT_LT(BuildPatches(scene, {}, cuts)->size(), 400) << "what is far away stays as it was";
}

TEST(MarkPatches, OfNoPatchIsNone) {
  const PatchSet patches = PatchesOf(MakeFurnace(0.5));
  const EdgeMarks marks = MarkPatches(patches, {});
  EXPECT_TRUE(marks.empty());
  EXPECT_EQ(CountHalved(patches, marks), patches.size());
}

TEST(BuildPatches, PiecesOfMarkedTrianglesKeepTheirSource) {
  const Scene scene = MakeFurnace(0.5);
  const PatchSet coarse = PatchesOf(scene);
  const Cuts cuts{.levels = {MarkPatches(coarse, {0})}};
  const PatchSet fine = *BuildPatches(scene, {}, cuts);
  ASSERT_GT(fine.size(), coarse.size());
  for (PatchIndex i = 0; i < fine.size(); ++i) {
    const auto parent = std::find(coarse.source.begin(), coarse.source.end(), fine.source[i]);
    ASSERT_NE(parent, coarse.source.end());
    EXPECT_EQ(PatchNormal(fine, i),
              PatchNormal(coarse, static_cast<PatchIndex>(parent - coarse.source.begin())));
  }
}

}  // namespace
}  // namespace lambert

#include "radiosity/pyramid/cluster_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "radiosity/pyramid/hemisphere.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

// The paper's rule, read aloud: the patches with at least one vertex in the pyramid.
std::vector<int32_t> CountByVertices(const PatchSet& patches, bool count_black,
                                     const LocalFrame& frame, const Hemisphere& hemisphere) {
  std::vector<int32_t> counts(hemisphere.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!count_black && patches.reflectance[i] == Rgb{}) continue;
    std::set<int> touched;
    for (const Vec3& corner : patches.corners[i]) {
      touched.insert(hemisphere.Locate(frame.ToLocal(corner)));
    }
    for (int p : touched) {
      if (p >= 0) ++counts[p];
    }
  }
  return counts;
}

void ExpectEqualCounts(PatchSet patches, const Hemisphere& hemisphere) {
  for (PatchIndex i = 0; i < patches.size(); i += 3) patches.reflectance[i] = {};
  for (const bool count_black : {false, true}) {
    const ClusterTree tree(patches.corners, CountedPatches(patches, count_black, true));
    const int step = std::max(1, patches.size() / 40);
    for (PatchIndex i = 0; i < patches.size(); i += step) {
      const LocalFrame frame = PatchFrame(patches, i);
      const std::vector<int32_t> expected =
          CountByVertices(patches, count_black, frame, hemisphere);
      EXPECT_EQ(tree.CountPatches(frame, hemisphere), expected) << "patch " << i;
      EXPECT_EQ(tree.CountPatches(frame, hemisphere, /*use_clusters=*/false), expected)
          << "patch " << i;
    }
  }
}

TEST(ClusterTree, CountsLikeTheVerticesOneByOneInAnOffice) {
  ExpectEqualCounts(PatchesOf(MakeOffice(3)), Hemisphere(4, 4, 2));
}

TEST(ClusterTree, CountsLikeTheVerticesOneByOneInACornellBox) {
  const PatchSet patches = PatchesOf(MakeCornell(5));
  ExpectEqualCounts(patches, Hemisphere(4, 4, 0));  // large pyramids hold whole clusters
  ExpectEqualCounts(patches, Hemisphere(5, 3, 2));
}

TEST(ClusterTree, CountsAClusterWithoutOpeningItWhereItFits) {
  // 128 small patches above the pole of a large one, all in the first of four pyramids.
  const PatchSet patches =
      PatchesOf(SceneMaker()
                    .Quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {1, 1, 1}}, 1)
                    .Quad({2, 2, 2}, {0, 0.1, 0}, {0.1, 0, 0}, {{0.5, 0.5, 0.5}, {}}, 8)
                    .Make());
  const ClusterTree tree(patches.corners, CountedPatches(patches, true, true));
  const LocalFrame frame{-patches.origin, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<int32_t> counts = tree.CountPatches(frame, Hemisphere(4, 4, 0));
  EXPECT_EQ(counts[0], 128 + 2);  // and the patches in the plane, which the horizon holds
  EXPECT_EQ(counts[2], 0);
}

TEST(ClusterTree, WithoutReflectingPatchesCountsNothing) {
  const PatchSet patches = PatchesOf(MakeBox(1, {0, 0, 0}, std::vector<Rgb>(6, {1, 1, 1})));
  const ClusterTree none(patches.corners, CountedPatches(patches, /*count_black=*/false, true));
  const ClusterTree all(patches.corners, CountedPatches(patches, /*count_black=*/true, true));
  const Hemisphere hemisphere(4, 4, 1);
  const LocalFrame frame = PatchFrame(patches, 0);
  EXPECT_EQ(none.CountPatches(frame, hemisphere), std::vector<int32_t>(hemisphere.size(), 0));
  EXPECT_NE(all.CountPatches(frame, hemisphere), std::vector<int32_t>(hemisphere.size(), 0));
}

TEST(PatchFrame, IsOrthonormalAtTheCentroidWithTheNormalAsZ) {
  const PatchSet patches = PatchesOf(MakeCornell(2));
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const LocalFrame f = PatchFrame(patches, i);
    EXPECT_NEAR(Length(f.x), 1, 1e-14);
    EXPECT_NEAR(Length(f.y), 1, 1e-14);
    EXPECT_NEAR(Length(Cross(f.x, f.y) - f.z), 0, 1e-14);
    EXPECT_NEAR(Dot(f.z, PatchNormal(patches, i)), 1, 1e-14);
    EXPECT_EQ(f.ToLocal(f.origin), Vec3());
    EXPECT_NEAR(f.ToLocal(f.origin + 2 * f.z).z, 2, 1e-14);
    for (const Vec3& corner : patches.corners[i]) EXPECT_NEAR(f.ToLocal(corner).z, 0, 1e-14);
  }
}

}  // namespace
}  // namespace lambert

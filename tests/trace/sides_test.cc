// Which side of a patch a ray sees.
#include <gtest/gtest.h>

#include <set>

#include "tests/support/cosine_shots.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

const Paint kGray{{0.5, 0.5, 0.5}, {1, 1, 1}};

// The one hit of a ray from `origin` [m, world].
PatchIndex TraceOne(const PatchSet& patches, const RayScene& scene, Vec3 origin, Vec3 direction) {
  auto batch = std::make_unique<RayBatch>();
  const Vec3 o = scene.ToTrace(origin - patches.origin);
  batch->size = 1;
  batch->origin_x[0] = static_cast<float>(o.x);
  batch->origin_y[0] = static_cast<float>(o.y);
  batch->origin_z[0] = static_cast<float>(o.z);
  batch->direction_x[0] = static_cast<float>(direction.x);
  batch->direction_y[0] = static_cast<float>(direction.y);
  batch->direction_z[0] = static_cast<float>(direction.z);
  scene.Trace(*batch);
  return batch->hit[0];
}

// Two rooms that share a wall, or nearly: every ray must stay in the room that it starts in.
void ExpectRoomsApart(double gap_m, int n_a, int n_b) {
  const PatchSet patches =
      PatchesOf(SceneMaker()
                    .Box({0, 0, 0}, {1, 1, 1}, true, {kGray}, n_a, "a")
                    .Box({1 + gap_m, 0, 0}, {2 + gap_m, 1, 1}, true, {kGray}, n_b, "b")
                    .Make());
  const auto scene = *RayScene::Create(patches);
  int64_t escaped = 0, through = 0;
  ShootCosineRays(
      patches, *scene, 200000, [](PatchIndex) { return true; },
      [&](PatchIndex from, PatchIndex hit) {
        escaped += hit == kEscaped;
        through += hit >= 0 && patches.source[hit].node != patches.source[from].node;
      });
  EXPECT_EQ(escaped, 0) << gap_m << " " << n_a << " " << n_b;
  EXPECT_EQ(through, 0) << gap_m << " " << n_a << " " << n_b;
}

TEST(Sides, RoomsBackToBackKeepTheirRays) {
  for (double gap_m : {0.0, 1e-6, 1e-3, 0.1}) {
    ExpectRoomsApart(gap_m, 1, 1);
    ExpectRoomsApart(gap_m, 1, 3);  // other edges and diagonals in the same plane
    ExpectRoomsApart(gap_m, 8, 5);
  }
}

TEST(Sides, CoincidentWallsWithCrossedDiagonalsEachShowTheirOwn) {
  // The same square twice, facing +x and -x, cut along one diagonal and along the other.
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Quad({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, kGray, 1, "to +x")
                                         .Quad({1, 1, 0}, {0, 0, 1}, {0, -1, 0}, kGray, 1, "other")
                                         .Quad({1, 1, 0}, {0, -1, 0}, {0, 0, 1}, kGray, 1, "to -x")
                                         .Make());
  const auto scene = *RayScene::Create(patches);
  ASSERT_NEAR(PatchNormal(patches, 0).x * PatchNormal(patches, 0).x, 1, 1e-12);
  for (int k = 0; k < 2000; ++k) {
    const double y = 0.01 + 0.98 * (k % 50) / 49.0, z = 0.013 + 0.97 * (k / 50) / 39.0;
    for (double side : {-1.0, 1.0}) {
      const PatchIndex hit =
          TraceOne(patches, *scene, {1 + side, y + 0.1, z - 0.1}, {-side, -0.1, 0.1});
      ASSERT_GE(hit, 0) << k;
      EXPECT_GT(PatchNormal(patches, hit).x * side, 0) << k;
    }
  }
}

TEST(Sides, ATwoSidedTriangleShowsItsFrontInFrontAndItsBackBehind) {
  Paint two_sided = kGray;
  two_sided.two_sided = true;
  const PatchSet patches =
      PatchesOf(SceneMaker().Quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, two_sided, 2).Make());
  ASSERT_EQ(patches.size(), 16);
  const auto scene = *RayScene::Create(patches);
  for (double x : {0.1, 0.3, 0.6, 0.9}) {
    for (double y : {0.15, 0.45, 0.7, 0.85}) {
      const PatchIndex front = TraceOne(patches, *scene, {x, y, 1}, {0, 0, -1});
      const PatchIndex back = TraceOne(patches, *scene, {x, y, -1}, {0, 0, 1});
      ASSERT_GE(front, 0);
      EXPECT_EQ(patches.is_back[front], 0);
      EXPECT_EQ(back, patches.twin[front]);
      EXPECT_GT(PatchNormal(patches, front).z, 0);
      EXPECT_LT(PatchNormal(patches, back).z, 0);
    }
  }
}

TEST(Sides, BacksOfOneSidedPatchesEndRays) {
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, kGray, 1, "up")
                                         .Quad({0, 0, 2}, {0, 1, 0}, {1, 0, 0}, kGray, 1, "down")
                                         .Make());
  const auto scene = *RayScene::Create(patches);
  EXPECT_EQ(TraceOne(patches, *scene, {0.4, 0.3, 0}, {0, 0, 1}), kEscaped);
  const PatchIndex hit = TraceOne(patches, *scene, {0.4, 0.3, 1.5}, {0, 0, 1});
  ASSERT_GE(hit, 0);
  EXPECT_EQ(patches.node_names[patches.source[hit].node], "down");
}

// Visibility is symmetric, or shooting and gathering would solve different scenes: nothing reaches
// the floor under a block, and nothing leaves it.
TEST(Sides, NothingLeavesTheFloorUnderABlock) {
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Box({0, 0, 0}, {3, 3, 3}, true, {kGray}, 1, "room")
                                         .Box({1, 0, 1}, {2, 1, 2}, false, {kGray}, 1, "block")
                                         .Make());
  const auto scene = *RayScene::Create(patches);
  for (int k = 0; k < 100; ++k) {
    const Vec3 under{1.05 + 0.9 * (k % 10) / 9.0, 1e-6, 1.05 + 0.9 * (k / 10) / 9.0};
    EXPECT_EQ(TraceOne(patches, *scene, under, {0.3, 0.5 + 0.01 * k, -0.2}), kEscaped);
  }
}

}  // namespace
}  // namespace lambert

#include <gtest/gtest.h>

#include "tests/support/statistics.h"
#include "tests/trace/closed_rooms.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 1000000;

TEST(Leak, ACubeLosesNoRay) { ExpectNoLoss(ConvexRooms()[0].patches, kRays, "cube"); }

TEST(Leak, ATurnedFineCubeLosesNoRay) {
  ExpectNoLoss(Turned(ConvexRooms()[1].patches), kRays, "turned fine cube");
}

TEST(Leak, ASphereLosesNoRay) { ExpectNoLoss(ConvexRooms()[4].patches, kRays, "sphere"); }

TEST(Leak, ACornellBoxClosedInFrontLosesNoRay) {
  ExpectNoLoss(ClosedCornell(2), kRays, "Cornell box");
}

TEST(Leak, RoomsOfEveryShapeLoseNoRayTurnedOrNot) {
  for (const auto& [name, patches] : ConvexRooms()) {
    ExpectNoLoss(patches, kRays / 20, name);
    ExpectNoLoss(Turned(patches), kRays / 20, name + ", turned");
  }
  ExpectNoLoss(Turned(ClosedCornell(7)), kRays / 20, "Cornell box, turned");
}

// Where two walls meet at an angle a under 90 degrees, a ray that starts nearer to the edge than
// kOriginOffset / tan a starts beyond the other wall. Two walls about 1 long: that share of the
// rays.
TEST(Leak, AcuteCornersLoseNoMoreThanTheRaysThatStartBeyondTheOtherWall) {
  for (double angle_rad : {1.0, 0.5, 0.1, 0.02}) {
    for (double max_edge_m : {0.0, 0.1}) {
      const Losses losses = CountLosses(Turned(Wedge(angle_rad, max_edge_m)), kRays / 20);
      const double expected =
          static_cast<double>(losses.rays) * 2 * kOriginOffset / std::tan(angle_rad);
      EXPECT_LE(static_cast<double>(losses.escaped), expected + kSigmas * std::sqrt(expected) + 1)
          << angle_rad << " " << max_edge_m;
    }
  }
}

TEST(Leak, ABoxWithoutItsLidLosesWhatItsFormFactorSays) {
  // From the floor of a unit cube to its lid: F = 0.1998.
  PatchSet patches = PatchesOf(SceneMaker()
                                   .Quad({}, {0, 0, 1}, {1, 0, 0}, {{}, {1, 1, 1}}, 1, "floor")
                                   .Quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {}, 1, "back")
                                   .Quad({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {}, 1, "front")
                                   .Quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}, 1, "left")
                                   .Quad({1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {}, 1, "right")
                                   .Make());
  const auto scene = *RayScene::Create(patches);
  int64_t rays = 0, escaped = 0;
  ShootCosineRays(
      patches, *scene, 200000, [&](PatchIndex i) { return patches.source[i].node == 0; },
      [&](PatchIndex, PatchIndex hit) {
        ++rays;
        escaped += hit == kEscaped;
      });
  const double f = 0.199825, n = static_cast<double>(rays);
  EXPECT_NEAR(static_cast<double>(escaped) / n, f, 4 * std::sqrt(f * (1 - f) / n));
}

}  // namespace
}  // namespace lambert

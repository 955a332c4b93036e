#include <gtest/gtest.h>

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

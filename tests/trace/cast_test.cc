#include <gtest/gtest.h>

#include "radiosity/trace/ray_scene.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

Vec3 At(const PatchSet& patches, const PictureHit& hit) {
  const auto& [a, b, c] = patches.corners[hit.patch];
  return a * (1 - hit.u - hit.v) + b * hit.u + c * hit.v;
}

TEST(Cast, BarycentricWeightsAndDistanceGiveThePoint) {
  Scene scene = MakeOffice(1);
  for (Material& material : scene.materials) material.two_sided = true;  // backs have weights too
  const PatchSet patches = PatchesOf(scene);
  const auto rays = *RayScene::Create(patches);
  TestRandom random(1);
  int backs = 0;
  for (int k = 0; k < 5000; ++k) {
    // World 0..6, 0..3, 0..8 m, also from within furniture.
    const Vec3 eye =
        Vec3{random.Uniform(0.1, 5.9), random.Uniform(0.1, 2.9), random.Uniform(0.1, 7.9)} -
        patches.origin;
    const Vec3 direction = random.Direction();
    const PictureHit hit = rays->Cast(eye, direction * random.Uniform(0.01, 100));
    ASSERT_NE(hit.patch, kNoPatch);
    ASSERT_GE(std::min({hit.u, hit.v, 1 - hit.u - hit.v}), -1e-6);
    // Floats of coordinates under 1 and a scene of 10 m: some 1e-6 m, more at grazing angles.
    const Vec3 point = eye + direction * hit.distance_m;
    const double grazing = std::abs(Dot(PatchNormal(patches, hit.patch), direction));
    ASSERT_LT(Length(At(patches, hit) - point), 1e-5 / std::max(grazing, 1e-3)) << k;
    ASSERT_LT(Dot(PatchNormal(patches, hit.patch), direction), 1e-6) << "seen from behind";
    backs += patches.is_back[hit.patch];
  }
  EXPECT_GT(backs, 5);
}

// The weights of a traced ray are those of the same ray that is cast.
TEST(Cast, AgreesWithTraceOnWhereAPatchIsHit) {
  Scene scene = MakeOffice(1);
  for (size_t k = 0; k < scene.materials.size(); k += 2) scene.materials[k].two_sided = true;
  const PatchSet patches = PatchesOf(scene);
  const auto rays = *RayScene::Create(patches);
  TestRandom random(2);
  RayBatch batch;
  std::vector<PictureHit> expected;
  while (batch.size < RayBatch::kCapacity) {
    const Vec3 eye =
        Vec3{random.Uniform(0.1, 5.9), random.Uniform(0.1, 2.9), random.Uniform(0.1, 7.9)} -
        patches.origin;
    const Vec3 direction = random.Direction();
    batch.Add(rays->ToTrace(eye), direction);
    expected.push_back(rays->Cast(eye, direction));
  }
  rays->Trace(batch);
  int alike = 0, backs = 0;
  for (int k = 0; k < batch.size; ++k) {
    // A traced ray ends at the back of a one-sided patch; one that is cast goes through.
    if (batch.hit[k] != expected[k].patch) continue;
    ++alike;
    backs += patches.is_back[batch.hit[k]];
    EXPECT_NEAR(batch.hit_u[k], expected[k].u, 1e-3) << k;
    EXPECT_NEAR(batch.hit_v[k], expected[k].v, 1e-3) << k;
  }
  EXPECT_GT(alike, RayBatch::kCapacity / 2);
  EXPECT_GT(backs, 0);
}

TEST(Cast, SeesTheNearestFrontAndThroughBacks) {
  const Paint gray{{0.5, 0.5, 0.5}, {1, 1, 1}};
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Quad({0, 0, 1}, {0, 1, 0}, {1, 0, 0}, gray, 1, "away")
                                         .Quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, gray, 1, "near")
                                         .Quad({0, 0, -1}, {1, 0, 0}, {0, 1, 0}, gray, 1, "far")
                                         .Make());
  const auto scene = *RayScene::Create(patches);
  const Vec3 eye = Vec3{0.3, 0.4, 5} - patches.origin;
  const PictureHit hit = scene->Cast(eye, {0, 0, -1});
  ASSERT_NE(hit.patch, kNoPatch);
  EXPECT_EQ(patches.node_names[patches.source[hit.patch].node], "near");
  EXPECT_NEAR(hit.distance_m, 5, 1e-5);
  const PictureHit below = scene->Cast(Vec3{0.3, 0.4, -5} - patches.origin, {0, 0, 1});
  ASSERT_NE(below.patch, kNoPatch);
  EXPECT_EQ(patches.node_names[patches.source[below.patch].node], "away");
}

TEST(Cast, OfARayPastEverythingIsNoPatch) {
  const PatchSet patches = PatchesOf(MakeCornell(1));
  const auto scene = *RayScene::Create(patches);
  EXPECT_EQ(scene->Cast(Vec3{1, 1, 1.9} - patches.origin, {0, 0, 1}).patch, kNoPatch);
}

TEST(Cast, LooksIntoAClosedRoomFromOutside) {
  const PatchSet patches = PatchesOf(MakeFurnace(0.5));
  const auto scene = *RayScene::Create(patches);
  const PictureHit hit = scene->Cast(Vec3{0.4, 0.3, 9} - patches.origin, {0, 0, -1});
  ASSERT_NE(hit.patch, kNoPatch);
  EXPECT_GT(PatchNormal(patches, hit.patch).z, 0.99);  // the far wall
}

}  // namespace
}  // namespace lambert

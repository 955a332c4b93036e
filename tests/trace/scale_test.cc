// The same hits at any scale and anywhere.
#include <gtest/gtest.h>

#include "tests/support/cosine_shots.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

PatchSet Scaled(PatchSet patches, double scale, Vec3 shift) {
  for (auto& corners : patches.corners) {
    for (Vec3& p : corners) p = p * scale + shift;
  }
  for (double& area : patches.area_m2) area *= scale * scale;
  return patches;
}

std::vector<PatchIndex> Hits(const PatchSet& patches) {
  const auto scene = *RayScene::Create(patches);
  std::vector<PatchIndex> hits;
  ShootCosineRays(
      patches, *scene, 100000, [](PatchIndex) { return true; },
      [&](PatchIndex, PatchIndex hit) { hits.push_back(hit); });
  return hits;
}

double UnequalFraction(const std::vector<PatchIndex>& a, const std::vector<PatchIndex>& b) {
  EXPECT_EQ(a.size(), b.size());
  double unequal = 0;
  for (size_t k = 0; k < a.size(); ++k) unequal += a[k] != b[k];
  return unequal / static_cast<double>(a.size());
}

TEST(Scale, ByAPowerOfTwoChangesNoHit) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const std::vector<PatchIndex> hits = Hits(patches);
  for (double scale : {0x1p-66, 0x1p-20, 0x1p20, 0x1p50}) {
    EXPECT_EQ(UnequalFraction(Hits(Scaled(patches, scale, {})), hits), 0) << scale;
  }
}

// Other scales round corners otherwise, by 6e-8 of the scene: rays that near to an edge change
// sides. A hundredth of the rays pass within 1e-3 of the scene of an edge, so 1e-6 of them would;
// one more power of ten is for edges that are seen at small angles.
TEST(Scale, ByAnyFactorChangesHardlyAHit) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const std::vector<PatchIndex> hits = Hits(patches);
  for (double scale : {1e-20, 1e-6, 0.3, 1e6, 1e15}) {
    const std::vector<PatchIndex> scaled = Hits(Scaled(patches, scale, {}));
    EXPECT_LT(UnequalFraction(scaled, hits), 1e-4) << scale;
  }
}

TEST(Scale, FarFromTheOriginChangesHardlyAHit) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const std::vector<PatchIndex> hits = Hits(patches);
  const std::vector<PatchIndex> far = Hits(Scaled(patches, 1, {1234.5, -99999.25, 3e6}));
  EXPECT_LT(UnequalFraction(far, hits), 1e-4);
  // A millimetre room, half a kilometre away.
  const std::vector<PatchIndex> small = Hits(Scaled(patches, 1e-3, {500, 500, 500}));
  EXPECT_LT(UnequalFraction(small, hits), 1e-4);
}

TEST(Scale, PutsTheDiagonalOfTheSceneBetweenOneAndTwo) {
  const PatchSet patches = PatchesOf(MakeCornell(1));
  for (double scale : {1e-20, 1e-6, 1.0, 3.0, 1e15}) {
    const PatchSet scaled = Scaled(patches, scale, {7 * scale, 0, -2 * scale});
    const auto scene = *RayScene::Create(scaled);
    Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (const auto& corners : scaled.corners) {
      for (const Vec3& p : corners) {
        const Vec3 q = scene->ToTrace(p);
        low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
        high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
      }
    }
    EXPECT_GE(Length(high - low), 1 - 1e-12) << scale;
    EXPECT_LT(Length(high - low), 2 + 1e-12) << scale;
    EXPECT_NEAR(Length(high + low), 0, 1e-9) << scale;
    EXPECT_EQ(scene->scale(), std::exp2(std::round(std::log2(scene->scale())))) << "no power of 2";
  }
}

}  // namespace
}  // namespace lambert

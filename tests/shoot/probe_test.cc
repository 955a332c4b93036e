#include "radiosity/shoot/probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

TEST(ProbeWorth, CountsEachPatchOnceOrWeighsWhatIsHit) {
  const PatchSet patches = PatchesOf(MakeCornell(3));
  const auto scene = *RayScene::Create(patches);
  const Emitters emitters(patches, *scene);
  const CellSampler sampler(PyramidOptions{});
  const std::vector<uint32_t> rays(64, 40);  // more than fit one batch
  std::vector<double> worth_of_hit(patches.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) worth_of_hit[i] = 1 + i;
  std::vector<std::set<PatchIndex>> seen(64);
  std::vector<double> sums(64);
  uint32_t next = 0;
  const std::vector<double> counts =
      ProbeWorth(sampler, *scene, emitters.Frame(5), RandomStream{1, 5, 0, 0}, rays,
                 {DensityRule::kCount, nullptr}, [&](uint32_t ray, int32_t cell, PatchIndex hit) {
                   EXPECT_EQ(ray, next++);
                   EXPECT_EQ(cell, static_cast<int32_t>(ray / 40));
                   if (hit < 0) return;
                   seen[cell].insert(hit);
                   sums[cell] += worth_of_hit[hit];
                 });
  EXPECT_EQ(next, 64u * 40);
  const std::vector<double> weighed =
      ProbeWorth(sampler, *scene, emitters.Frame(5), RandomStream{1, 5, 0, 0}, rays,
                 {DensityRule::kVariance, &worth_of_hit}, nullptr);
  for (int p = 0; p < 64; ++p) {
    EXPECT_EQ(counts[p], seen[p].size());
    EXPECT_NEAR(weighed[p], sampler.fractions()[p] * std::sqrt(sums[p] / 40), 1e-12) << p;
  }
}

}  // namespace
}  // namespace lambert

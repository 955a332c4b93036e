#include "radiosity/shoot/probe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
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
  // The same rays, traced here, cell by cell.
  auto batch = std::make_unique<RayBatch>();
  float weight[RayBatch::kSlots];
  for (int32_t cell = 0; cell < 64; ++cell) {
    batch->size = 0;
    const auto first = static_cast<uint32_t>(40 * cell);
    sampler.Append(emitters.Frame(5), {}, std::vector<int32_t>(40, cell).data(),
                   RandomStream{1, 5, 0, 0}, first, first + 40, *batch, weight);
    scene->Trace(*batch);
    for (int k = 0; k < 40; ++k) {
      if (batch->hit[k] < 0) continue;
      seen[cell].insert(batch->hit[k]);
      sums[cell] += worth_of_hit[batch->hit[k]];
    }
  }
  const std::vector<double> counts =
      ProbeWorth(sampler, *scene, emitters.Frame(5), RandomStream{1, 5, 0, 0}, rays, {});
  const std::vector<double> weighed =
      ProbeWorth(sampler, *scene, emitters.Frame(5), RandomStream{1, 5, 0, 0}, rays,
                 {DensityRule::kVariance, &worth_of_hit});
  for (int p = 0; p < 64; ++p) {
    EXPECT_EQ(counts[p], seen[p].size());
    EXPECT_NEAR(weighed[p], sampler.fractions()[p] * std::sqrt(sums[p] / 40), 1e-12) << p;
  }
}

}  // namespace
}  // namespace lambert

#include "radiosity/shoot/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

TEST(WorthOfHits, CountsEachPatchOnceOrWeighsWhatIsHit) {
  const std::vector<CellHit> hits = {{1, 7}, {1, 9}, {1, 7}, {1, kEscaped}, {3, 9}, {4, kEscaped}};
  const std::vector<double> fractions = {0.1, 0.2, 0.3, 0.25, 0.15};
  EXPECT_EQ(WorthOfHits(hits, fractions, {}), (std::vector<double>{0, 2, 0, 1, 0}));
  std::vector<double> worth_of_hit(10);
  worth_of_hit[7] = 6;
  worth_of_hit[9] = 4;
  const std::vector<double> weighed =
      WorthOfHits(hits, fractions, {DensityRule::kVariance, &worth_of_hit});
  EXPECT_EQ(weighed, (std::vector<double>{0, 0.2 * std::sqrt(16.0 / 4), 0, 0.25 * 2, 0}));
}

TEST(ProbeWorth, IsThatOfRaysThroughEachCell) {
  const PatchSet patches = PatchesOf(MakeCornell(3));
  const auto scene = *RayScene::Create(patches);
  const Emitters emitters(patches, *scene);
  const CellSampler sampler(PyramidOptions{});
  constexpr int kRays = 40;  // in all more than fit one batch
  const RandomStream stream{1, 0, 0, 0};
  // The same rays, made and traced here, group by group.
  std::vector<CellHit> hits;
  auto batch = std::make_unique<RayBatch>();
  for (uint32_t ray = 0; ray < 64 * kRays; ray += 8) {
    CellRays8 rays;
    for (uint32_t lane = 0; lane < 8; ++lane) {
      rays.names.emitter[lane] = 5;
      rays.names.ray[lane] = ray + lane;
      rays.cells[lane] = static_cast<int32_t>(ray / kRays);
      rays.pyramids[lane] = sampler.Pyramid({}, rays.cells[lane]);
    }
    RandomNumbers8 numbers;
    FillRandomNumbers(stream, rays.names, numbers);
    float weight[RayBatch::kSlots];
    batch->size = 0;
    sampler.Append(emitters.Frames(rays.names.emitter), rays, numbers, stream, 8, *batch, weight);
    scene->Trace(*batch);
    for (int lane = 0; lane < 8; ++lane) hits.push_back({rays.cells[lane], batch->hit[lane]});
  }
  const std::vector<double> counts = ProbeWorth(sampler, *scene, emitters, 5, stream, kRays, {});
  EXPECT_EQ(counts, WorthOfHits(hits, sampler.fractions(), {}));
  EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 3);
}

}  // namespace
}  // namespace lambert

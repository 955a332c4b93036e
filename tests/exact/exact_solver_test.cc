#include "radiosity/exact/exact_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "radiosity/trace/ray_scene.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// A leg that stands on a floor exchanges next to nothing with most of it. Where the pilot saw no
// occluder such a pair expects few samples, and one of them counts by the inverse of that: more
// than a patch's whole light where the two all but touch.
TEST(ExactSolver, NoSampleOfAPairOutweighsItsPatches) {
  const PatchSet patches = PatchesOf(MakeOffice(1));
  const auto scene = RayScene::Create(patches);
  ASSERT_TRUE(scene.ok()) << scene.status();
  const ExactSolver solver(patches, **scene);
  const Exchange exchange(patches, **scene);
  std::vector<double> emitted;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    emitted.push_back(patches.area_m2[i] * Mean(patches.exitance_lm_per_m2[i]));
  }
  const Transport guess = exchange.Guess();
  const int64_t rays = static_cast<int64_t>(exchange.links().size());
  double worst = 0;  // error of a form factor
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    const Transport sampled = solver.SampleTransport(emitted, rays, seed, /*pass=*/0);
    for (const Link& link : exchange.links()) {
      const double off = sampled.exchange.at(link.i, link.j) - guess.exchange.at(link.i, link.j);
      const double area = std::min(patches.area_m2[link.i], patches.area_m2[link.j]);
      worst = std::max(worst, std::abs(off) / area);
    }
  }
  // No more than a sample of twice the patch's light. Without the least share of the samples that
  // every pair has it is 10, without that of pairs which all but touch 2.8.
  EXPECT_LT(worst, 2);
  EXPECT_GT(worst, 0);
}

}  // namespace
}  // namespace lambert

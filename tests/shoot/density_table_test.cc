#include "radiosity/shoot/density_table.h"

#include <gtest/gtest.h>

#include <thread>

#include "radiosity/pyramid/density.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

std::vector<float> Directly(const PatchSet& patches, const PyramidOptions& options, PatchIndex i) {
  const Hemisphere hemisphere(options.initial, options.split, options.depth);
  const ClusterTree tree(patches, options.count_black);
  return PyramidDensities(
      hemisphere, tree.CountPatches(PatchFrame(patches, i), hemisphere, options.use_clusters),
      options.alpha1, options.alpha2);
}

TEST(DensityTable, HoldsTheDensitiesOfEveryPatchAtTheFirstAndTheSecondCall) {
  const PatchSet patches = PatchesOf(MakeCornell(2));
  PyramidOptions options;
  options.alpha2 = 3;
  const DensityTable table(patches, options);
  EXPECT_EQ(table.hemisphere().size(), 64);
  for (PatchIndex i = 0; i < patches.size(); i += 7) {
    const std::vector<float> expected = Directly(patches, options, i);
    EXPECT_EQ(table.Get(i), expected);
    EXPECT_EQ(table.Get(i), expected);
  }
}

TEST(DensityTable, DoesNotDependOnClusters) {
  const PatchSet patches = PatchesOf(MakeOffice(1));
  PyramidOptions with, without;
  without.use_clusters = false;
  const DensityTable a(patches, with), b(patches, without);
  for (PatchIndex i = 0; i < patches.size(); i += 11) EXPECT_EQ(a.Get(i), b.Get(i));
}

TEST(DensityTable, GivesManyThreadsAtOnceTheSameDensities) {
  const PatchSet patches = PatchesOf(MakeCornell(2));
  const DensityTable shared(patches, {}), alone(patches, {});
  std::vector<int> wrong(4);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (PatchIndex i = 0; i < patches.size(); ++i) wrong[t] += shared.Get(i) != alone.Get(i);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(MinRaysForDensities, IsWhatIsAskedForOrElseGrowsWithTheSceneAndThePyramids) {
  const PatchSet small = PatchesOf(MakeCornell(1)), large = PatchesOf(MakeCornell(12));
  PyramidOptions options;
  const int64_t pyramids = 64;
  EXPECT_GE(MinRaysForDensities(small, options), pyramids);
  EXPECT_GT(MinRaysForDensities(large, options), MinRaysForDensities(small, options));
  PyramidOptions deep = options;
  deep.depth = 4;
  EXPECT_GE(MinRaysForDensities(small, deep), 1024);
  options.min_rays = 5;
  EXPECT_EQ(MinRaysForDensities(large, options), 5);
  EXPECT_EQ(DensityTable(small, options).min_rays(), 5);
}

}  // namespace
}  // namespace lambert

#include "radiosity/shoot/directions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>

#include "radiosity/pyramid/density.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// A patch set made ready, with the directions of its patches.
struct Made {
  Made(const Scene& from, const ShootOptions& options)
      : patches(PatchesOf(from)),
        tree(patches),
        scene(*RayScene::Create(patches)),
        emitters(patches, *scene),
        table(patches, *scene, emitters, options, ErrorWorth(patches, options.pyramids.metric),
              options.method == Method::kPhsHier ? &tree : nullptr) {}

  PatchSet patches;
  SurfaceTree tree;
  std::unique_ptr<RayScene> scene;
  Emitters emitters;
  DirectionTable table;
};

ShootOptions With(Method method) {
  ShootOptions options;
  options.method = method;
  return options;
}

std::vector<double> Densities(const CellSpans& spans) {
  std::vector<double> densities;
  for (int p = 0; p < spans.size(); ++p) densities.push_back(spans.density(p));
  return densities;
}

std::vector<double> CountedDirectly(const PatchSet& patches, const PyramidOptions& options,
                                    const LocalFrame& frame) {
  const CellSampler sampler(options);
  const ClusterTree tree(patches.corners, CountedPatches(patches, /*count_black=*/false, true));
  const std::vector<int32_t> counts = tree.CountPatches(frame, sampler.cells());
  return Densities(CellSpans(CellDensities(sampler.fractions(), {counts.begin(), counts.end()},
                                           options.alpha1, options.alpha2)));
}

TEST(DirectionTable, HoldsTheDensitiesOfEveryPatchAtTheFirstAndTheSecondCall) {
  for (CellShape shape : {CellShape::kTriangle, CellShape::kSquare}) {
    ShootOptions options = With(Method::kPhs);
    options.pyramids.alpha2 = 3;
    options.pyramids.cells = shape;
    const Made made(MakeCornell(2), options);
    EXPECT_EQ(made.table.sampler().cells().size(), 64);
    for (PatchIndex i = 0; i < made.patches.size(); i += 7) {
      const std::vector<double> expected =
          CountedDirectly(made.patches, options.pyramids, PatchFrame(made.patches, i));
      EXPECT_EQ(Densities(made.table.Get(i)->spans), expected);
      EXPECT_EQ(Densities(made.table.Get(i)->spans), expected);
    }
  }
}

TEST(DirectionTable, APatchOfFewRaysFollowsTheElementOfEnough) {
  ShootOptions options = With(Method::kPhsHier);
  options.pyramids.min_rays = 100;
  const Made made(MakeOffice(4), options);
  int elements = 0;
  for (PatchIndex i = 0; i < made.patches.size(); ++i) {
    EXPECT_EQ(made.table.PlaceFor({i, 100, 0, 100}, 0), i);
    EXPECT_EQ(made.table.PlaceFor({i, 99, 0, 99}, 0), kNoPatch);
    const PatchIndex place = made.table.PlaceFor({i, 99, 0, 99}, 50);
    if (place == kNoPatch) continue;
    ++elements;
    ASSERT_GE(place, made.patches.size());
    const Element& element = made.tree.elements()[place - made.patches.size()];
    EXPECT_GE(element.area_m2, 2);
    const auto begin = made.tree.order().begin();
    EXPECT_EQ(std::count(begin + element.begin, begin + element.end, i), 1);
    const int32_t within = made.tree.ParentOf(i);
    EXPECT_TRUE(made.tree.PlaceOf(within) == place || made.tree.elements()[within].area_m2 < 2);
    EXPECT_EQ(Densities(made.table.Get(place)->spans),
              CountedDirectly(made.patches, options.pyramids,
                              PlaceFrame(made.patches, made.tree, place)));
  }
  EXPECT_GT(elements, 100);
}

TEST(DirectionTable, WithoutATreeOnlyPatchesHaveDirections) {
  ShootOptions options = With(Method::kPhs);
  options.pyramids.min_rays = 100;
  const Made made(MakeOffice(1), options);
  EXPECT_EQ(made.table.PlaceFor({3, 100, 0, 100}, 1e9), 3);
  EXPECT_EQ(made.table.PlaceFor({3, 99, 0, 99}, 1e9), kNoPatch);
}

TEST(DirectionTable, ReadsThePatchesNoMoreWhereItCounts) {
  ShootOptions options = With(Method::kImportance);
  EXPECT_TRUE(ReadsPatches(options));
  options.method = Method::kPhs;
  EXPECT_FALSE(ReadsPatches(options));
  Made counted(MakeCornell(2), options);
  counted.patches = {};
  const PatchSet again = PatchesOf(MakeCornell(2));
  EXPECT_EQ(Densities(counted.table.Get(5)->spans),
            CountedDirectly(again, options.pyramids, PatchFrame(again, 5)));
}

TEST(DirectionTable, DoesNotDependOnClusters) {
  ShootOptions without = With(Method::kPhs);
  without.parts.without.Add(Part::kClusters);
  const Made a(MakeOffice(1), With(Method::kPhs)), b(MakeOffice(1), without);
  for (PatchIndex i = 0; i < a.patches.size(); i += 11) {
    EXPECT_EQ(Densities(a.table.Get(i)->spans), Densities(b.table.Get(i)->spans));
  }
}

TEST(DirectionTable, GivesManyThreadsAtOnceTheSameDensities) {
  const Made shared(MakeCornell(2), With(Method::kPhs)), alone(MakeCornell(2), With(Method::kPhs));
  std::vector<int> wrong(4);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      for (PatchIndex i = 0; i < shared.patches.size(); ++i) {
        wrong[t] += Densities(shared.table.Get(i)->spans) != Densities(alone.table.Get(i)->spans);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

// Every method's densities, by what they are made of, are positive and sum to 1.
TEST(DirectionTable, DividesAllRaysByEveryMethodAndRule) {
  for (Method method : {Method::kHs97, Method::kHs98, Method::kPhs, Method::kPhsAdaptive}) {
    for (DensityRule rule : {DensityRule::kCount, DensityRule::kVariance}) {
      ShootOptions options = With(method);
      options.pyramids.rule = rule;
      options.pyramids.leaves = 19;
      const Made made(MakeOffice(1), options);
      for (PatchIndex i = 0; i < made.patches.size(); i += 41) {
        const auto directions = made.table.Get(i);
        double sum = 0, fractions = 0;
        for (int p = 0; p < directions->spans.size(); ++p) {
          EXPECT_GT(directions->spans.density(p), 0);
          sum += directions->spans.density(p);
          fractions += made.table.sampler().Fraction(*directions, p);
          EXPECT_EQ(made.table.sampler().Pyramid(*directions, p)->flux_fraction(),
                    made.table.sampler().Fraction(*directions, p));
        }
        EXPECT_EQ(sum, 1);
        EXPECT_NEAR(fractions, 1, 1e-12);
        if (method == Method::kPhsAdaptive) {
          EXPECT_EQ(directions->spans.size(), 19);
        }
      }
    }
  }
}

TEST(DirectionTable, KnowsTheDensitiesOfTheFlux) {
  const Made made(MakeCornell(1), With(Method::kHs97));
  const CellSpans& spans = made.table.by_flux().spans;
  for (int p = 0; p < 64; ++p) {
    EXPECT_NEAR(spans.density(p), made.table.sampler().fractions()[p], 1e-7) << p;
  }
}

TEST(ErrorWorth, FallsWithTheAreaAsTheMetricSays) {
  const PatchSet patches = PatchesOf(MakeOffice(1));
  const std::vector<double> unweighted = ErrorWorth(patches, 0), weighted = ErrorWorth(patches, 1);
  for (PatchIndex j = 1; j < patches.size(); j += 17) {
    const double rho = Mean(patches.reflectance[j]) / Mean(patches.reflectance[0]);
    const double area = patches.area_m2[j] / patches.area_m2[0];
    EXPECT_NEAR(unweighted[j] / unweighted[0] / (rho * rho / (area * area)), 1, 1e-12);
    EXPECT_NEAR(weighted[j] / weighted[0] / (rho * rho / area), 1, 1e-12);
  }
}

TEST(MinRaysForDensities, IsWhatIsAskedForOrElseGrowsWithTheSceneAndThePyramids) {
  const PatchSet small = PatchesOf(MakeCornell(1)), large = PatchesOf(MakeCornell(12));
  ShootOptions options = With(Method::kPhs);
  const int64_t pyramids = 64;
  EXPECT_GE(MinRaysForDensities(small, options), pyramids);
  EXPECT_GT(MinRaysForDensities(large, options), MinRaysForDensities(small, options));
  ShootOptions deep = options;
  deep.pyramids.depth = 4;
  EXPECT_GE(MinRaysForDensities(small, deep), 1024);
  ShootOptions probing = With(Method::kHs97);
  probing.pyramids.probes = 3;
  EXPECT_EQ(MinRaysForDensities(small, probing), 2 * 3 * pyramids);
  options.pyramids.min_rays = 5;
  EXPECT_EQ(MinRaysForDensities(large, options), 5);
}

}  // namespace
}  // namespace lambert

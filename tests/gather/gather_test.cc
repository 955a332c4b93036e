// Final gather against closed forms, and against itself in another order.
#include "radiosity/gather/gather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

#include "radiosity/gather/lamp_tree.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr Paint kBlack{{0, 0, 0}, {0, 0, 0}};

std::shared_ptr<const PatchSet> Shared(const Scene& scene) {
  return std::make_shared<const PatchSet>(PatchesOf(scene));
}

// Gathers where nothing is reflected: what leaves is what is emitted.
Gathered Direct(const std::shared_ptr<const PatchSet>& patches, const GatherPoints& points,
                const GatherOptions& options = {}) {
  return (*(*GatherHere(patches, patches->exitance_lm_per_m2, options))(points));
}

// Points given in world coordinates.
GatherPoints At(const PatchSet& patches, const std::vector<Vec3>& positions, Vec3 normal) {
  GatherPoints points;
  for (const Vec3& p : positions) points.Add(p - patches.origin, normal);
  return points;
}

// Configuration factor of a point to a parallel rectangle a x b at height c whose corner lies
// straight above (Howell B-3).
double CornerFactor(double a, double b, double c) {
  const double x = a / c, y = b / c, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / (2 * std::numbers::pi);
}

TEST(Gather, InAFurnaceEverythingArrivesEverywhere) {
  const auto patches = Shared(MakeFurnace(0.5, 1, 2));  // E = B = 1 / (1 - .5)
  const std::vector<Rgb> radiosity(patches->size(), Rgb{2, 2, 2});
  const auto gather = GatherHere(patches, radiosity, {});
  GatherPoints points = At(*patches, {{.5, .5, .5}, {.9, .1, .3}, {.2, .2, .8}}, {0, 0, 1});
  points.Add(PatchCentroid(*patches, 7), PatchNormal(*patches, 7));
  const Gathered gathered = *(*gather)(points);
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_NEAR(gathered.irradiance_lx[i].g, 2, kSigmas * gathered.std_error_lx[i].g + 1e-6) << i;
    EXPECT_LT(gathered.std_error_lx[i].g, 0.1);
  }
}

TEST(Gather, UnderARectangularLampIsItsConfigurationFactor) {
  SceneMaker maker;
  maker.Quad({0, 2, 0}, {1, 0, 0}, {0, 0, 3}, {{0, 0, 0}, {100, 50, 25}});  // faces down
  const auto patches = Shared(maker.Make());
  // Straight under a corner, near and far, so that both ways to sample a lamp are met.
  for (double depth : {0.1, 2.0, 40.0}) {
    SampleMean mean;
    double expected = 100 * CornerFactor(1, 3, depth);
    for (uint64_t seed = 1; seed <= 64; ++seed) {
      const Gathered gathered =
          Direct(patches, At(*patches, {{0, 2 - depth, 0}}, {0, 1, 0}), {64, seed});
      mean.Add(gathered.irradiance_lx[0].r);
      EXPECT_NEAR(gathered.irradiance_lx[0].g * 2, gathered.irradiance_lx[0].r, 1e-9 * expected);
    }
    EXPECT_NEAR(mean.mean(), expected, kSigmas * mean.std_error() + 1e-5 * expected) << depth;
    EXPECT_LT(mean.std_error(), 0.01 * expected) << depth;
  }
}

TEST(Gather, UnderAPointLightIsTheInverseSquareLaw) {
  SceneMaker maker;
  maker.Quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, kBlack).Light({2, 3, 2}, {90, 9, 0});
  const auto patches = Shared(maker.Make());
  const Gathered gathered = Direct(patches, At(*patches, {{2, 0, 2}, {3, 0, 2}}, {0, 1, 0}));
  EXPECT_NEAR(gathered.irradiance_lx[0].r, 10, 1e-9);
  EXPECT_NEAR(gathered.irradiance_lx[0].g, 1, 1e-9);
  EXPECT_NEAR(gathered.irradiance_lx[1].r, 90 * 3 / std::pow(10, 1.5), 1e-9);
  EXPECT_EQ(gathered.std_error_lx[0], Rgb());
}

TEST(Gather, WhatStandsBetweenCastsASharpShadow) {
  SceneMaker maker;
  maker.Quad({0, 2, 0}, {1, 0, 0}, {0, 0, 1}, {{0, 0, 0}, {1, 1, 1}});
  maker.Quad({-1, 1.9, -1}, {0, 0, 3}, {3, 0, 0}, kBlack);
  maker.Light({0.5, 3, 0.5}, {1, 1, 1});
  const auto patches = Shared(maker.Make());
  const Gathered gathered =
      Direct(patches, At(*patches, {{0.5, 0, 0.5}, {0.5, 1.95, 0.5}}, {0, 1, 0}));
  EXPECT_EQ(gathered.irradiance_lx[0], Rgb());
  EXPECT_GT(gathered.irradiance_lx[1].r, 0.9);
}

// What all lamps send to a point where nothing stands between, from an even grid over each.
double SumOverLamps(const PatchSet& patches, Vec3 point, Vec3 normal) {
  constexpr int kGrid = 24;
  double sum = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int k = 0; k < kGrid * kGrid; ++k) {
      const double xi1 = (k / kGrid + 0.5) / kGrid, xi2 = (k % kGrid + 0.5) / kGrid;
      sum += SampleLamp(patches, i, point, normal, xi1, xi2).irradiance_lx.r / (kGrid * kGrid);
    }
  }
  return sum;
}

TEST(Gather, OfManyLampsIsTheSumOfAll) {
  SceneMaker maker;
  TestRandom random(1);
  for (int k = 0; k < 300; ++k) {  // a ceiling of 600 lamps: more than a point tells apart
    maker.Quad({k % 20 * 0.5, 2, k / 20 * 0.5}, {0.2, 0, 0}, {0, 0, 0.3},
               {{0, 0, 0}, Rgb{1, 1, 1} * random.Uniform(0.1, 100)});
  }
  const auto patches = Shared(maker.Make());
  ASSERT_GT(patches->size(), LampTree::kMostPieces);
  const Vec3 normal = Normalized(Vec3{1, 3, 0});
  const GatherPoints points = At(*patches, {{0, 0, 0}, {5, 0, 4}, {5.05, 1.95, 4.1}}, normal);
  for (size_t i = 0; i < points.size(); ++i) {
    SampleMean mean;
    for (uint64_t seed = 1; seed <= 32; ++seed) {
      mean.Add(Direct(patches, points, {64, seed}).irradiance_lx[i].r);
    }
    const double expected = SumOverLamps(*patches, points.position_m[i], normal);
    EXPECT_NEAR(mean.mean(), expected, kSigmas * mean.std_error() + 2e-3 * expected);
    EXPECT_LT(mean.std_error(), 0.02 * expected);
  }
}

TEST(Gather, ItsStandardErrorIsItsSpread) {
  const auto patches = Shared(MakeOffice(1));
  std::vector<Rgb> radiosity = patches->exitance_lm_per_m2;
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    radiosity[i] = radiosity[i] + Rgb{1, 1, 1} * (100.0 * (i % 7));
  }
  GatherPoints points;
  for (PatchIndex i = 0; i < patches->size(); i += 5) {
    points.Add(PatchCentroid(*patches, i), PatchNormal(*patches, i));
  }
  constexpr int kSeeds = 40;
  double spread = 0, told = 0;
  std::vector<SampleMean> means(points.size());
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Gathered gathered = *(*GatherHere(patches, radiosity, {32, seed}))(points);
    for (size_t i = 0; i < points.size(); ++i) {
      means[i].Add(gathered.irradiance_lx[i].r);
      told += gathered.std_error_lx[i].r * gathered.std_error_lx[i].r / kSeeds;
    }
  }
  for (const SampleMean& mean : means) spread += mean.std_error() * mean.std_error() * kSeeds;
  // Both are means of many squares; 10 % is four standard deviations of either.
  EXPECT_NEAR(told / spread, 1, 0.1);
}

TEST(Gather, APointDependsOnItsNameAlone) {
  const auto patches = Shared(MakeCornell(2));
  const std::vector<Rgb> radiosity(patches->size(), Rgb{3, 2, 1});
  GatherPoints points;
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    points.Add(PatchCentroid(*patches, i), PatchNormal(*patches, i));
  }
  const auto gatherer = *Gatherer::Create(patches, radiosity, {20, 7});
  const Gathered all = gatherer->Run(points, 0, points.size(), 5);
  for (size_t begin = 0; begin < points.size(); begin += 50) {
    const size_t end = std::min(begin + 50, points.size());
    const Gathered part = gatherer->Run(points, begin, end, 5);
    for (size_t i = begin; i < end; ++i) {
      EXPECT_EQ(part.irradiance_lx[i - begin], all.irradiance_lx[i]);
      EXPECT_EQ(part.std_error_lx[i - begin], all.std_error_lx[i]);
    }
  }
  EXPECT_NE(gatherer->Run(points, 0, points.size(), 6), all);
}

TEST(Gather, NoPointGivesNonsense) {
  const auto patches = Shared(MakeCornell(1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  GatherPoints points;
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    for (const Vec3& corner : patches->corners[i]) {  // on edges, also of the lamp, both ways
      points.Add(corner, PatchNormal(*patches, i));
      points.Add(corner, -PatchNormal(*patches, i));
    }
    points.Add(PatchCentroid(*patches, i) - PatchNormal(*patches, i) * 0.01,
               PatchNormal(*patches, i));
  }
  points.Add({nan, 0, 0}, {0, 1, 0});
  points.Add({0, 0, 0}, {0, 0, 0});
  points.Add({0, 0, 0}, {0, nan, 0});
  const Gathered gathered = Direct(patches, points, {16, 1});
  for (size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(IsFinite(gathered.irradiance_lx[i])) << i;
    EXPECT_TRUE(IsFinite(gathered.std_error_lx[i])) << i;
    EXPECT_GE(Mean(gathered.irradiance_lx[i]), 0) << i;
  }
  EXPECT_EQ(gathered.irradiance_lx.back(), Rgb());
}

}  // namespace
}  // namespace lambert

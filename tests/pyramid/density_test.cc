#include "radiosity/pyramid/density.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/support/statistics.h"

namespace lambert {
namespace {

std::vector<double> Fractions(const HemisphereCells& cells) {
  std::vector<double> fractions;
  for (int p = 0; p < cells.size(); ++p) fractions.push_back(cells.flux_fraction(p));
  return fractions;
}

double Sum(const std::vector<float>& densities) {
  return std::accumulate(densities.begin(), densities.end(), 0.0);
}

std::vector<double> RandomCounts(int size, TestRandom& random) {
  std::vector<double> counts(size);
  for (double& n : counts) n = static_cast<double>(std::max<int64_t>(0, random.Below(40) - 20));
  return counts;
}

TEST(CellDensities, ArePositiveAndSumToOne) {
  TestRandom random(1);
  for (int depth = 0; depth <= 3; ++depth) {
    const Hemisphere hemisphere(4, 4, depth);
    for (const auto& [alpha1, alpha2] :
         {std::pair{1.0, 1.0}, std::pair{0.0, 1.0}, std::pair{1.0, 0.0}, std::pair{0.2, 5.0}}) {
      const std::vector<float> densities = CellDensities(
          Fractions(hemisphere), RandomCounts(hemisphere.size(), random), alpha1, alpha2);
      ASSERT_EQ(densities.size(), static_cast<size_t>(hemisphere.size()));
      for (float density : densities) EXPECT_GT(density, 0);
      // Each is rounded to float by at most 2^-24 of itself.
      EXPECT_NEAR(Sum(densities), 1, 0x1p-24);
    }
  }
}

TEST(CellDensities, AreThePapersFormula) {
  const Hemisphere hemisphere(4, 4, 0);  // f_p = 1/4 each
  const std::vector<float> densities = CellDensities(Fractions(hemisphere), {6, 3, 1, 0}, 1, 3);
  const double g[4] = {0.6, 0.3, 0.1, 0};
  for (int p = 0; p < 4; ++p) EXPECT_NEAR(densities[p], (1 * 0.25 + 3 * g[p]) / 4, 1e-7) << p;
}

TEST(CellDensities, WithNothingCountedAreTheFluxFractions) {
  const Hemisphere hemisphere(5, 3, 2);
  const std::vector<float> densities =
      CellDensities(Fractions(hemisphere), std::vector<double>(hemisphere.size(), 0), 0.3, 0.9);
  for (int p = 0; p < hemisphere.size(); ++p) {
    EXPECT_NEAR(densities[p] / hemisphere.pyramid(p).flux_fraction(), 1, 1e-6);
  }
}

TEST(CellDensities, KeepAHundredthOfTheFluxFractionWhereNothingIsCounted) {
  const Hemisphere hemisphere(4, 4, 0);
  const std::vector<float> densities = CellDensities(Fractions(hemisphere), {1, 0, 0, 0}, 0, 1);
  const double share = 0.01 * 0.25, sum = 1 + 3 * share;
  EXPECT_NEAR(densities[0], 1 / sum, 1e-7);
  for (int p = 1; p < 4; ++p) EXPECT_NEAR(densities[p] / (share / sum), 1, 1e-6);
}

TEST(LeastVariance, DividesBySquareRoots) {
  const std::vector<double> worth = LeastVariance({0.25, 0.25, 0.5}, {0, 0.25, 2});
  EXPECT_EQ(worth, (std::vector<double>{0, 0.25, 1}));
}

TEST(SplitWhereWorthIs, SplitsTheWorthiestUntilThereAreEnough) {
  const Hemisphere hemisphere(4, 4, 2);
  std::vector<double> worth(64);
  worth[17] = 5;  // in initial triangle 1, child 0
  const AdaptivePyramids four = SplitWhereWorthIs(hemisphere, worth, 4);
  EXPECT_EQ(four.pyramids.size(), 4u);
  const AdaptivePyramids ten = SplitWhereWorthIs(hemisphere, worth, 12);
  ASSERT_EQ(ten.pyramids.size(), 10u);  // 3 whole, 3 quarters, 4 sixteenths: 13 would be too many
  double fractions = 0;
  for (size_t k = 0; k < ten.pyramids.size(); ++k) {
    fractions += ten.pyramids[k]->flux_fraction();
    if (ten.worth[k] > 0) {
      EXPECT_EQ(ten.pyramids[k], &hemisphere.pyramid(17));
    }
  }
  EXPECT_NEAR(fractions, 1, 1e-12);
  EXPECT_NEAR(std::accumulate(ten.worth.begin(), ten.worth.end(), 0.0), 5, 0);
  EXPECT_EQ(SplitWhereWorthIs(hemisphere, worth, 1000).pyramids.size(), 64u);
}

// Rays of each cell, told by the cells of rays `first`, `first` + `step`, ...
std::vector<uint32_t> RaysOfCells(const CellSpans& spans, uint32_t ray_count, uint32_t offset,
                                  uint32_t step) {
  std::vector<uint32_t> rays(spans.size());
  VisitCells cells(spans, ray_count, offset);
  for (uint64_t ray = 0; ray < ray_count; ray += step) {
    const CellRays& at = cells.Of(static_cast<uint32_t>(ray));
    EXPECT_LE(at.begin, ray);
    EXPECT_GT(at.end, ray);
    const double expected = spans.density(at.cell) * ray_count;
    EXPECT_NEAR(at.share, std::min(expected, 1.0) * (at.end - at.begin), 1e-9 * at.share);
    rays[at.cell] = at.end - at.begin;
  }
  return rays;
}

TEST(CellSpans, AreTheDensitiesAndNeverEmpty) {
  const std::vector<float> densities = {0.25f, 1e-20f, 0.5f, 0.125f, 0.125f};
  const CellSpans spans(densities);
  ASSERT_EQ(spans.size(), 5);
  double sum = 0;
  for (int p = 0; p < 5; ++p) {
    EXPECT_NEAR(spans.density(p), densities[p], 5 * 0x1p-32) << p;
    EXPECT_GT(spans.density(p), 0) << p;
    sum += spans.density(p);
  }
  EXPECT_EQ(sum, 1);
  EXPECT_EQ(CellSpans().size(), 0);
}

TEST(VisitCells, RaysSumToExactlyTheRaysAndDifferFromTheirExpectationByLessThanOne) {
  TestRandom random(2);
  const Hemisphere hemisphere(4, 4, 2);
  for (int k = 0; k < 2000; ++k) {
    const CellSpans spans(
        CellDensities(Fractions(hemisphere), RandomCounts(hemisphere.size(), random), 1, 1));
    const bool many = k % 5 == 0;
    const uint32_t wanted =
        many ? ~0u - static_cast<uint32_t>(k) : 1 + static_cast<uint32_t>(random.Below(300));
    const uint32_t offset = k % 7 == 0 ? ~0u : static_cast<uint32_t>(random.Bits());
    const std::vector<uint32_t> rays =
        RaysOfCells(spans, wanted, offset, many ? wanted / 100000 : 1);
    uint64_t total = 0;
    for (int p = 0; p < spans.size(); ++p) {
      total += rays[p];
      ASSERT_LT(std::abs(rays[p] - spans.density(p) * wanted), 1) << k << " " << p;
    }
    ASSERT_EQ(total, wanted);
  }
}

// A count is floor(x + offset) - floor(y + offset). Over a grid of offsets each floor has the mean
// of its argument up to half a grid step, and the two errors stay under one step together.
TEST(VisitCells, RaysHaveTheMeanOfTheirDensities) {
  constexpr uint32_t kGrid = 4096;
  TestRandom random(3);
  const Hemisphere hemisphere(4, 4, 1);
  for (uint32_t wanted : {1u, 3u, 40u, 1000u}) {
    const CellSpans spans(
        CellDensities(Fractions(hemisphere), RandomCounts(hemisphere.size(), random), 1, 2));
    std::vector<double> mean(spans.size());
    for (uint32_t k = 0; k < kGrid; ++k) {
      const std::vector<uint32_t> rays = RaysOfCells(spans, wanted, k * (1u << 20) + (1u << 19), 1);
      for (size_t p = 0; p < rays.size(); ++p) mean[p] += 1.0 * rays[p] / kGrid;
    }
    for (int p = 0; p < spans.size(); ++p) {
      EXPECT_NEAR(mean[p], spans.density(p) * wanted, 1.0 / kGrid) << wanted << " " << p;
    }
  }
}

TEST(VisitCells, AreTheSameFromAnyRayOn) {
  TestRandom random(4);
  const CellSpans spans(
      CellDensities(std::vector<double>(100, 0.01), RandomCounts(100, random), 1, 1));
  for (uint32_t wanted : {20u, 70u, 99u, 100u, 500u}) {
    VisitCells all(spans, wanted, 12345);
    for (uint32_t ray = 0; ray < wanted; ++ray) {
      ASSERT_EQ(VisitCells(spans, wanted, 12345).Of(ray).cell, all.Of(ray).cell) << ray;
    }
  }
}

}  // namespace
}  // namespace lambert

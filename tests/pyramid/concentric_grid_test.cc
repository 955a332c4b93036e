#include "radiosity/pyramid/concentric_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/statistics.h"

namespace lambert {
namespace {

// Directions of the cosine law, by another way than the concentric map.
Vec3 CosineDirection(TestRandom& random) {
  const double radius = std::sqrt(random.Uniform());
  const double angle = 2 * std::numbers::pi * random.Uniform();
  return {radius * std::cos(angle), radius * std::sin(angle), std::sqrt(1 - radius * radius)};
}

TEST(ConcentricGrid, CellsTakeEqualFlux) {
  TestRandom random(4);
  for (int side : {1, 2, 5, 8}) {
    const ConcentricGrid grid(side);
    ASSERT_EQ(grid.size(), side * side);
    std::vector<int64_t> counts(grid.size());
    for (int k = 0; k < 100000; ++k) {
      const Vec3 d = CosineDirection(random);
      const int cell = grid.Locate(d);
      ASSERT_EQ(cell, grid.Locate(d * 17));  // of any length
      ++counts[cell];
    }
    EXPECT_DOUBLE_EQ(grid.flux_fraction(0) * grid.size(), 1);
    if (side > 1) {
      EXPECT_LT(ChiSquared(counts, std::vector<double>(grid.size(), grid.flux_fraction(0))),
                ChiSquaredQuantile(grid.size() - 1))
          << side;
    }
  }
}

TEST(ConcentricGrid, LocatesThePoleTheHorizonAndNothingBelow) {
  const ConcentricGrid grid(3);
  EXPECT_EQ(grid.Locate({0, 0, 1}), 4);
  EXPECT_EQ(grid.Locate({1, 0, 0}), 5);
  EXPECT_EQ(grid.Locate({0, 1, 0}), 7);
  EXPECT_EQ(grid.Locate({0, 0, -1}), -1);
  EXPECT_FALSE(grid.HoldsBall(4, {0, 0, 1}, 1e-9));
  EXPECT_EQ(grid.side(), 3);
}

}  // namespace
}  // namespace lambert

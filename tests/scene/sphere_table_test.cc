#include "radiosity/scene/sphere_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "radiosity/core/error.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

std::shared_ptr<const SphereTable> Table(SphereGrid grid) {
  auto table = SphereTable::Create(std::move(grid));
  EXPECT_TRUE(table.ok()) << table.status();
  return *table;
}

// Uneven in both, with a row of nothing.
SphereGrid Uneven(bool linear) {
  SphereGrid grid{linear, 1, {-1, -0.6, 0.1, 0.3, 0.9}, {-0.25, 0, 0.4}, {}};
  const size_t less = linear ? 0 : 1;
  for (size_t k = 0; k < (5 - less) * (3 - less); ++k) {
    grid.values.push_back(k / (3 - less) == 1 ? 0.0f : static_cast<float>(1 + (7 * k) % 5));
  }
  return grid;
}

TEST(TurnOf, EqualsTheStandardLibrary) {
  for (int k = -1000; k <= 1000; ++k) {
    const double turn = k / 2000.0;
    EXPECT_NEAR(TurnOf(3 * std::cos(2 * kPi * turn), 3 * std::sin(2 * kPi * turn)),
                turn == -0.5 ? -0.5 : turn, 1e-12);
  }
  EXPECT_EQ(TurnOf(0, 0), 0);
  EXPECT_EQ(TurnOf(-1, 0), 0.5);
}

TEST(SphereTable, IntegralsOfSkiesAreClosedForms) {
  const auto uniform = Table({true, 1, {0, 1}, {0, 1}, {1, 1, 1, 1}});
  EXPECT_NEAR(uniform->total().r, 2 * kPi, 1e-12);
  EXPECT_NEAR(uniform->CosineTotal().r, kPi, 1e-12);
  const auto overcast = Table({true, 1, {0, 1}, {0, 1}, {1, 1, 3, 3}});
  EXPECT_NEAR(overcast->total().g, 4 * kPi, 1e-12);
  EXPECT_NEAR(overcast->CosineTotal().b, 7 * kPi / 3, 1e-12);  // 7/9 pi of 3
  // Half of a row lies under the horizon.
  const auto low = Table({false, 1, {-1, 1}, {0, 1}, {2}});
  EXPECT_NEAR(low->CosineTotal().r, 2 * kPi, 1e-12);
  EXPECT_EQ(low->Greatest(), 2);
}

TEST(SphereTable, ValuesAreBilinearOrOfTheirCell) {
  const auto table = Table({true, 1, {0, 1}, {0, 0.5}, {1, 2, 3, 8}});
  const double z = 0.5, radius = std::sqrt(1 - z * z);
  EXPECT_NEAR(table->Value({0, radius, z}).r, 3.5, 1e-12);  // a quarter turn: the middle
  EXPECT_EQ(table->Value({0, -radius, z}).r, 0);
  EXPECT_EQ(table->Value({0, 0.6, -0.8}).r, 0);
  const auto cells =
      Table({false, 3, {-1, 0, 1}, {-0.5, 0, 0.5}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}});
  EXPECT_EQ(cells->Value({0, -0.8, -0.6}), (Rgb{1, 2, 3}));
  EXPECT_EQ(cells->Value({0, 0.8, -0.6}), (Rgb{4, 5, 6}));
  EXPECT_EQ(cells->Value({0, -0.8, 0.6}), (Rgb{7, 8, 9}));
  EXPECT_EQ(cells->Value({0, 0, 1}), (Rgb{10, 11, 12}));
}

// Counts in bins of z and turn, against the integral of the value over each.
TEST(SphereTable, SamplesFollowTheValues) {
  constexpr int kZ = 20, kTurn = 20;
  for (bool linear : {true, false}) {
    const auto table = Table(Uneven(linear));
    std::vector<double> expected(kZ * kTurn);
    constexpr int kFine = 40;
    for (int i = 0; i < kZ * kFine; ++i) {
      for (int j = 0; j < kTurn * kFine; ++j) {
        const double z = -1 + 2 * (i + 0.5) / (kZ * kFine),
                     turn = (j + 0.5) / (kTurn * kFine) - 0.5;
        const double radius = std::sqrt(1 - z * z);
        expected[i / kFine * kTurn + j / kFine] +=
            table->Value({radius * std::cos(2 * kPi * turn), radius * std::sin(2 * kPi * turn), z})
                .r *
            4 * kPi / (kZ * kFine * kTurn * kFine) / table->total().r;
      }
    }
    EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), 1, 1e-3);
    TestRandom random(7);
    std::vector<int64_t> counts(kZ * kTurn);
    for (int k = 0; k < 200000; ++k) {
      const SphereTable::Sample sample = table->Draw(random.Uniform(), random.Uniform());
      ASSERT_NEAR(Length(sample.direction), 1, 1e-12);
      ASSERT_NEAR(sample.density, sample.value.r / table->total().r, 1e-12);
      ASSERT_NEAR(sample.value.r, table->Value(sample.direction).r, 1e-9 + (linear ? 0 : 10));
      const double turn = TurnOf(sample.direction.x, sample.direction.y);
      const int i = std::clamp(static_cast<int>((sample.direction.z + 1) / 2 * kZ), 0, kZ - 1);
      const int j = std::clamp(static_cast<int>((turn + 0.5) * kTurn), 0, kTurn - 1);
      ++counts[i * kTurn + j];
    }
    std::vector<int64_t> seen;
    std::vector<double> of_seen;
    for (size_t k = 0; k < counts.size(); ++k) {
      if (expected[k] < 1e-4) continue;  // too few to count
      seen.push_back(counts[k]);
      of_seen.push_back(expected[k]);
    }
    const double all = std::accumulate(of_seen.begin(), of_seen.end(), 0.0);
    for (double& p : of_seen) p /= all;
    EXPECT_LT(ChiSquared(seen, of_seen), ChiSquaredQuantile(seen.size() - 1)) << linear;
  }
}

// The mean of value / density is the total, channel by channel, and none is far over its share.
TEST(SphereTable, SamplesOfColorsAreUnbiasedInEachChannel) {
  const auto table =
      Table({false, 3, {-1, 0, 1}, {-0.5, 0, 0.5}, {1, 0, 9, 4, 0, 1, 1000, 0, 2, 1, 0, 1}});
  TestRandom random(3);
  SampleMean means[3];
  for (int k = 0; k < 20000; ++k) {
    const SphereTable::Sample sample = table->Draw(random.Uniform(), random.Uniform());
    for (int c = 0; c < 3; ++c) {
      const double estimate = sample.value[c] / sample.density;
      ASSERT_LE(estimate, 3.001 * table->total()[c]);
      means[c].Add(estimate);
    }
  }
  for (int c : {0, 2}) {
    EXPECT_NEAR(means[c].mean(), table->total()[c], 4 * means[c].std_error());
  }
  EXPECT_EQ(means[1].mean(), 0);
}

TEST(SphereTable, GridsThatCannotBeAreRefused) {
  const SphereGrid good = Uneven(true);
  const auto refused = [&](auto change) {
    SphereGrid grid = good;
    change(grid);
    return ReasonOf(SphereTable::Create(grid).status()) == "TABLE_INVALID";
  };
  EXPECT_TRUE(refused([](SphereGrid& g) { g.z[1] = -1; }));
  EXPECT_TRUE(refused([](SphereGrid& g) { g.z[4] = 1.5; }));
  EXPECT_TRUE(refused([](SphereGrid& g) { g.z = {0}; }));
  EXPECT_TRUE(refused([](SphereGrid& g) { g.turn[2] = 0.8; }));
  EXPECT_TRUE(refused([](SphereGrid& g) { g.values.pop_back(); }));
  EXPECT_TRUE(refused([](SphereGrid& g) { g.channels = 2; }));
  EXPECT_TRUE(refused([](SphereGrid& g) { g.values[0] = -1; }));
  EXPECT_TRUE(refused([](SphereGrid& g) { g.values[0] = std::nanf(""); }));
}

}  // namespace
}  // namespace lambert

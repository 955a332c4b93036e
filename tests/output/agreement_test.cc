#include "radiosity/output/agreement.h"

#include <cmath>
#include <random>

#include "gtest/gtest.h"

namespace lambert {
namespace {

// `n` equal patches of 1 m2 that each get the same light.
PatchTable EvenTable(PatchIndex n, double std_error) {
  PatchTable table;
  for (PatchIndex i = 0; i < n; ++i) {
    table.source.push_back({0, 0, 0, i});
    table.corners.push_back({Vec3{0.0 + i, 0, 0}, Vec3{1.0 + i, 0, 0}, Vec3{0.0 + i, 1, 0}});
  }
  table.area_m2.assign(n, 1);
  table.reflectance.assign(n, {0.5, 0.5, 0.5});
  table.exitance_lm_per_m2.assign(n, {});
  table.radiosity_lm_per_m2.assign(n, {1, 1, 1});
  table.irradiance_lx.assign(n, {2, 2, 2});
  table.std_error_lm_per_m2.assign(n, {std_error, std_error, std_error});
  return table;
}

// Runs whose patches are off by normal errors of the stated size, `shared` of their variance common
// to each run's patches, and by `bias`.
std::vector<Deviations> RunsWith(int runs, PatchIndex patches, double error, double shared,
                                 double bias) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<Deviations> made;
  for (int k = 0; k < runs; ++k) {
    const double common = normal(random);
    Deviations& run = made.emplace_back();
    for (PatchIndex i = 0; i < patches; ++i) {
      const double own = normal(random);
      const double off = std::sqrt(shared) * common + std::sqrt(1 - shared) * own;
      run.difference.push_back(static_cast<float>(bias + error * off));
      run.variance.push_back(static_cast<float>(error * error));
    }
  }
  return made;
}

Agreement AgreementOf(const std::vector<Deviations>& runs, const PatchTable& reference) {
  std::vector<const Deviations*> pointers;
  for (const Deviations& run : runs) pointers.push_back(&run);
  return *Agree(pointers, 1e9, reference);
}

TEST(Agreement, DeviationsAreByPatchOfTheReferenceWhateverTheOrder) {
  PatchTable reference = EvenTable(2, 0), run = EvenTable(2, 0.5);
  reference.area_m2 = {1, 3};
  reference.radiosity_lm_per_m2 = {{0, 1, 0}, {0, 2, 0}};
  run.radiosity_lm_per_m2 = {{0, 2.25, 0}, {0, 5, 0}};
  run.area_m2 = {3, 1};
  std::swap(run.source[0], run.source[1]);
  std::swap(run.corners[0], run.corners[1]);
  const auto deviations = DeviationsFrom(run, reference);
  ASSERT_TRUE(deviations.ok()) << deviations.status();
  EXPECT_EQ(deviations->difference, (std::vector<float>{4, 0.25}));
  EXPECT_EQ(deviations->variance, (std::vector<float>{0.25, 0.25}));
  EXPECT_FALSE(DeviationsFrom(run, EvenTable(3, 0)).ok());
}

TEST(Agreement, ZIsTheMeanOverItsOwnErrorAndThatOfTheReference) {
  const PatchTable reference = EvenTable(1, 2);
  // Means 3, variance of the mean (6 + 10) / 4, of the reference 4: z2 = 9 / 8.
  const Deviations a{{1}, {6}}, b{{5}, {10}};
  const auto agreement = Agree({&a, &b}, 1e9, reference);
  ASSERT_TRUE(agreement);
  EXPECT_EQ(agreement->patches, 1);
  EXPECT_DOUBLE_EQ(agreement->mean_z2, 9.0 / 8);
  // Each is off the mean by 2, of variance (1 - 1/2) 8.
  EXPECT_DOUBLE_EQ(*agreement->null_z2, 1);
  EXPECT_DOUBLE_EQ(*agreement->null_z2_sd, 0);
  EXPECT_FALSE(Agree({&a}, 1e9, reference)->null_z2) << "one run has no others";
}

TEST(Agreement, AnErrorThatIsNotKnownIsNone) {
  PatchTable run = EvenTable(2, 0.1);
  run.std_error_lm_per_m2[1] = kUnknownError;
  const auto deviations = DeviationsFrom(run, EvenTable(2, 0));
  ASSERT_TRUE(deviations.ok());
  EXPECT_GT(deviations->variance[0], 0);
  EXPECT_EQ(deviations->variance[1], 0);
}

TEST(Agreement, NullIsThatOfRunsWithoutBias) {
  const PatchTable reference = EvenTable(200, 0);
  const Agreement fair = AgreementOf(RunsWith(32, 200, 0.1, 0, 0), reference);
  EXPECT_EQ(fair.patches, 200);
  // Of 200 independent patches: 1 +- sqrt(2 / 200). The deviation is of 32 runs: known to 1/8.
  EXPECT_NEAR(fair.mean_z2, 1, 3 * 0.1);
  EXPECT_NEAR(*fair.null_z2, 1, 3 * 0.1 / std::sqrt(32));
  EXPECT_NEAR(*fair.null_z2_sd, 0.1, 3 * 0.1 / 8);
}

TEST(Agreement, BiasThatNoRunShowsIsSeenInTheirMean) {
  // A fifth of a run's error, 1.13 of that of the mean of 32: z2 is 1 + 1.28, in units of .1.
  const Agreement biased = AgreementOf(RunsWith(32, 200, 0.1, 0, 0.02), EvenTable(200, 0));
  EXPECT_GT(biased.mean_z2, *biased.null_z2 + 3 * *biased.null_z2_sd);
}

TEST(Agreement, ErrorsThatPatchesShareSpreadTheNull) {
  const PatchTable reference = EvenTable(200, 0);
  const Agreement alone = AgreementOf(RunsWith(32, 200, 0.1, 0, 0), reference);
  const Agreement shared = AgreementOf(RunsWith(32, 200, 0.1, 0.5, 0), reference);
  // Correlation .5: the variance of mean z2 is (2 / 200) (1 + 199 / 4), seven times the deviation.
  EXPECT_GT(*shared.null_z2_sd, 3 * *alone.null_z2_sd);
}

TEST(Agreement, PatchesOfFewHitsAreLeftOut) {
  PatchTable reference = EvenTable(2, 0);
  reference.irradiance_lx = {{3, 3, 3}, {1, 1, 1}};  // of all rays three quarters, one quarter
  const Deviations run{{1, 1}, {1, 1}};
  EXPECT_EQ(Agree({&run}, 4 * kEnoughHits, reference)->patches, 2);
  EXPECT_EQ(Agree({&run}, 4 * kEnoughHits - 1, reference)->patches, 1);
  EXPECT_FALSE(Agree({&run}, kEnoughHits, reference));
  const Deviations certain{{1, 1}, {0, 0}};
  EXPECT_FALSE(Agree({&certain}, 1e9, reference)) << "no error is stated";
}

}  // namespace
}  // namespace lambert

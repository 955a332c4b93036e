#include "radiosity/output/reference.h"

#include <cmath>

#include "gtest/gtest.h"

namespace lambert {
namespace {

// Patches of 1 and 3 m2, one a node, that reflect the given radiosities and emit nothing.
PatchTable TableOf(double first, double second, double std_error) {
  PatchTable table;
  const double areas[] = {1, 3}, radiosities[] = {first, second};
  for (int k = 0; k < 2; ++k) {
    const double b = radiosities[k];
    table.source.push_back({k, 0, 0, 0});
    table.area_m2.push_back(areas[k]);
    table.corners.push_back({});
    table.reflectance.push_back({0.5, 0.5, 0.5});
    table.exitance_lm_per_m2.push_back({});
    table.radiosity_lm_per_m2.push_back({b, b, b});
    table.irradiance_lx.push_back({2 * b, 2 * b, 2 * b});
    table.std_error_lm_per_m2.push_back({std_error, std_error, std_error});
  }
  return table;
}

TEST(JoinHalves, TheMeanOfBothWithHalfTheirDifferenceAsResidual) {
  const auto reference = JoinHalves(TableOf(5, 4, 3), TableOf(3, 4, 4), {0});
  ASSERT_TRUE(reference.ok()) << reference.status();
  const PatchTable& table = reference->table;
  EXPECT_DOUBLE_EQ(table.radiosity_lm_per_m2[0].g, 4);
  EXPECT_DOUBLE_EQ(table.irradiance_lx[0].g, 8);
  EXPECT_DOUBLE_EQ(table.std_error_lm_per_m2[0].g, 2.5);  // sqrt(3^2 + 4^2) / 2
  // mean_A = 4; half the difference: 1 on 1 of 4 m2, on one of two patches.
  EXPECT_DOUBLE_EQ(*reference->residual.rms_area, 0.5 / 4);
  EXPECT_DOUBLE_EQ(*reference->residual.rms_patch, std::sqrt(0.5) / 4);
  EXPECT_DOUBLE_EQ(*reference->residual.rms_local, 1.0 / 4);
  EXPECT_FALSE(reference->residual.power_bias);
}

TEST(JoinHalves, ARegionWithoutPatchesIsRefused) {
  EXPECT_FALSE(JoinHalves(TableOf(1, 1, 0), TableOf(1, 1, 0), {7}).ok());
}

TEST(JudgeReference, TheStandardErrorsOfATableAreItsResidual) {
  const auto reference = JudgeReference(TableOf(4, 4, 1), {});
  ASSERT_TRUE(reference.ok());
  EXPECT_DOUBLE_EQ(*reference->residual.rms_area, 0.25);
  EXPECT_DOUBLE_EQ(*reference->residual.rms_patch, 0.25);
  EXPECT_FALSE(reference->residual.rms_local);
  EXPECT_DOUBLE_EQ(reference->table.radiosity_lm_per_m2[1].r, 4);
  EXPECT_DOUBLE_EQ(*JudgeReference(TableOf(4, 4, 0), {})->residual.rms_area, 0);
}

TEST(JudgeReference, StandardErrorsThatAreNotKnownAreNoResidual) {
  PatchTable table = TableOf(4, 4, 1);
  table.std_error_lm_per_m2[1] = kUnknownError;
  EXPECT_FALSE(JudgeReference(table, {})->residual.rms_area);
  const auto joined = JoinHalves(TableOf(4, 4, 1), table, {});
  EXPECT_EQ(joined->table.std_error_lm_per_m2[1], kUnknownError);
  EXPECT_GT(joined->table.std_error_lm_per_m2[0].r, 0);
}

}  // namespace
}  // namespace lambert

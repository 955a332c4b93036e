#include "radiosity/output/compare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "radiosity/core/error.h"
#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// Patches of the given areas, one a node, that reflect half of the given irradiance.
PatchTable TableOf(const std::vector<double>& areas, const std::vector<double>& irradiances) {
  PatchTable table;
  for (size_t k = 0; k < areas.size(); ++k) {
    const double x = static_cast<double>(k), e = irradiances[k];
    table.source.push_back({static_cast<int32_t>(k), 0, 0, 0});
    table.area_m2.push_back(areas[k]);
    table.corners.push_back({Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x, 0, 2 * areas[k]}});
    table.reflectance.push_back({0.5, 0.5, 0.5});
    table.exitance_lm_per_m2.push_back({10, 10, 10});
    table.radiosity_lm_per_m2.push_back(Rgb{10, 10, 10} + Rgb{e, e, e} * 0.5);
    table.irradiance_lx.push_back({e, e, e});
    table.std_error_lm_per_m2.push_back({});
  }
  return table;
}

TEST(Compare, ATableEqualsItself) {
  const PatchTable table = TableOf({1, 2, 3}, {4, 5, 6});
  const absl::StatusOr<ErrorMeasures> measures = Compare(table, table, {1});
  ASSERT_TRUE(measures.ok());
  EXPECT_EQ(measures->rms_area, 0);
  EXPECT_EQ(measures->rms_patch, 0);
  EXPECT_EQ(measures->rms_local, 0);
  EXPECT_EQ(measures->p95, 0);
  EXPECT_EQ(measures->power_bias, 0);
}

TEST(Compare, MeasuresFollowTheirFormulas) {
  // Reflected: 2 and 4 lm/m2 on 1 and 3 m2, mean_A = (2 + 12) / 4 = 3.5; errors: 1 and -.5.
  const PatchTable reference = TableOf({1, 3}, {4, 8}), table = TableOf({1, 3}, {6, 7});
  const absl::StatusOr<ErrorMeasures> measures = Compare(table, reference, {1});
  ASSERT_TRUE(measures.ok());
  EXPECT_DOUBLE_EQ(*measures->rms_patch, std::sqrt((1 + 0.25) / 2) / 3.5);
  EXPECT_DOUBLE_EQ(*measures->rms_area, std::sqrt((1 + 3 * 0.25) / 4) / 3.5);
  EXPECT_DOUBLE_EQ(*measures->rms_local, 0.5 / 4);
  // Relative errors .125 and .5: between them, .95 of the way.
  EXPECT_DOUBLE_EQ(*measures->p95, 0.125 + 0.95 * (0.5 - 0.125));
  EXPECT_DOUBLE_EQ(*measures->power_bias, (3 + 3 * 3.5) / (2 + 3 * 4.0) - 1);
}

TEST(Compare, DarkPatchesCountAsAHundredthOfTheMean) {
  // Mean reflected 1; the second patch reflects nothing and is off by .03.
  const PatchTable reference = TableOf({1, 1}, {4, 0}), table = TableOf({1, 1}, {4, 0.06});
  EXPECT_NEAR(*Compare(table, reference)->p95, 0.95 * 0.03 / 0.01, 1e-9);
}

TEST(Compare, NoRegionGivesNoLocalError) {
  const PatchTable table = TableOf({1}, {4});
  EXPECT_EQ(Compare(table, table)->rms_local, std::nullopt);
}

TEST(Compare, ARegionWithoutPatchesIsRefused) {
  const PatchTable table = TableOf({1}, {4});
  EXPECT_EQ(ReasonOf(Compare(table, table, {7}).status()), "REGION_EMPTY");
}

TEST(Compare, ADarkReferenceLeavesMeasuresEmpty) {
  const PatchTable dark = TableOf({1, 1}, {0, 0});
  const absl::StatusOr<ErrorMeasures> measures = Compare(dark, dark);
  ASSERT_TRUE(measures.ok());
  EXPECT_EQ(measures->rms_area, std::nullopt);
  EXPECT_EQ(measures->power_bias, std::nullopt);
}

TEST(Compare, PatchesInAnotherOrderArePairedByOriginAndCorners) {
  const PatchTable reference = TableOf({1, 2, 3}, {4, 5, 6});
  PatchTable turned = TableOf({1, 2, 3}, {4, 5, 6});
  auto turn = [](auto& column) { std::rotate(column.begin(), column.begin() + 1, column.end()); };
  turn(turned.source);
  turn(turned.area_m2);
  turn(turned.corners);
  turn(turned.radiosity_lm_per_m2);
  turn(turned.irradiance_lx);
  const absl::StatusOr<ErrorMeasures> measures = Compare(turned, reference);
  ASSERT_TRUE(measures.ok()) << measures.status();
  EXPECT_EQ(measures->rms_area, 0);
}

TEST(Compare, TablesOfOtherPatchesAreRefused) {
  const absl::StatusOr<ErrorMeasures> measures =
      Compare(TableOf({1, 2}, {4, 5}), TableOf({1, 2, 3}, {4, 5, 6}));
  EXPECT_EQ(ReasonOf(measures.status()), "TABLES_DIFFER");
}

TEST(Compare, HugeAndTinyScalesGiveTheSameRatios) {
  for (double scale : {1e-30, 1e30}) {
    PatchTable reference = TableOf({1, 3}, {4, 8}), table = TableOf({1, 3}, {6, 7});
    for (PatchTable* one : {&reference, &table}) {
      for (auto* column : {&one->radiosity_lm_per_m2, &one->exitance_lm_per_m2}) {
        for (Rgb& value : *column) value = value * scale;
      }
    }
    EXPECT_NEAR(*Compare(table, reference)->rms_patch, std::sqrt(1.25 / 2) / 3.5, 1e-12);
  }
}

}  // namespace
}  // namespace lambert

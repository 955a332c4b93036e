#include "radiosity/output/bench_summary.h"

#include <algorithm>
#include <cmath>

#include "gtest/gtest.h"

namespace lambert {
namespace {

BenchRun RunOf(const std::string& method, const std::string& budget, uint64_t seed, double error,
               int64_t rays, double cpu_seconds) {
  BenchRun run;
  run.method = method;
  run.budget = budget;
  run.seed = seed;
  run.progress.rays = rays;
  run.progress.cpu_seconds = cpu_seconds;
  run.progress.estimated_rms_area = error / 2;
  run.measures = {error, 2 * error, std::nullopt, error, error - 2};
  run.deviations = {{static_cast<float>(error)}, {4}};
  return run;
}

// One lit patch.
PatchTable Reference() {
  PatchTable table;
  table.source.resize(1);
  table.area_m2 = {1};
  table.radiosity_lm_per_m2 = table.irradiance_lx = {{1, 1, 1}};
  table.std_error_lm_per_m2.resize(1);
  return table;
}

std::vector<BenchSummary> SummariesOf(const std::vector<BenchRun>& runs) {
  return SummarizeRuns(runs, Reference());
}

TEST(BenchSummary, ErrorsAreSquaredThenAveragedThenRooted) {
  const auto summaries =
      SummariesOf({RunOf("pmcr", "100", 1, 1, 90, 2), RunOf("pmcr", "100", 2, 7, 110, 4)});
  ASSERT_EQ(summaries.size(), 1u);
  const BenchSummary& s = summaries[0];
  EXPECT_EQ(s.seeds, 2);
  EXPECT_DOUBLE_EQ(s.rays, 100);
  EXPECT_DOUBLE_EQ(s.cpu_seconds, 3);
  EXPECT_DOUBLE_EQ(*s.measures.rms_area, 5);  // sqrt((1 + 49) / 2)
  EXPECT_DOUBLE_EQ(*s.measures.rms_patch, 10);
  EXPECT_FALSE(s.measures.rms_local);
  EXPECT_DOUBLE_EQ(*s.measures.p95, 4);
  EXPECT_DOUBLE_EQ(*s.measures.power_bias, 2);
  EXPECT_DOUBLE_EQ(*s.power_bias_se, 3);  // of -1 and 5: sqrt((9 + 9) / (2 * 1)) = 3 = sd / sqrt(2)
  EXPECT_DOUBLE_EQ(*s.estimated_rms_area, 2.5);
  EXPECT_DOUBLE_EQ(*s.estimated_over_true, 0.5);
  EXPECT_FALSE(s.agreement) << "200 rays are too few hits";
}

TEST(BenchSummary, EfficiencyIsRelativeToTheFirstMethodAtTheSameBudget) {
  const auto summaries =
      SummariesOf({RunOf("pmcr", "1", 1, 4, 100, 1), RunOf("phs", "1", 1, 2, 100, 8),
                   RunOf("pmcr", "2", 1, 2, 400, 4), RunOf("phs", "2", 1, 1, 200, 4)});
  ASSERT_EQ(summaries.size(), 4u);
  EXPECT_EQ(summaries[1].method, "phs");
  EXPECT_DOUBLE_EQ(*summaries[0].per_ray_area, 1);
  EXPECT_DOUBLE_EQ(*summaries[1].per_ray_area, 4);    // a half of the error, the same rays
  EXPECT_DOUBLE_EQ(*summaries[1].per_cpu_area, 0.5);  // in eight times the time
  EXPECT_DOUBLE_EQ(*summaries[2].per_ray_area, 1);
  EXPECT_DOUBLE_EQ(*summaries[3].per_ray_area, 8);
  EXPECT_DOUBLE_EQ(*summaries[3].per_cpu_patch, 4);
}

TEST(BenchSummary, WhatOneSeedLacksStaysEmpty) {
  std::vector<BenchRun> runs = {RunOf("pmcr", "1", 1, 4, 100, 1), RunOf("pmcr", "1", 2, 4, 100, 1)};
  runs[1].progress.estimated_rms_area = -1;
  runs[1].measures.power_bias.reset();
  runs[0].peak_rss_bytes = 7;
  const BenchSummary s = SummariesOf(runs)[0];
  EXPECT_FALSE(s.estimated_rms_area);
  EXPECT_FALSE(s.estimated_over_true);
  EXPECT_FALSE(s.power_bias_se);
  EXPECT_EQ(s.peak_rss_bytes, 7);
  EXPECT_FALSE(SummariesOf({runs[0]})[0].power_bias_se) << "one seed has no spread";
}

TEST(BenchSummary, TheTableHasOneLineEachAndEveryColumn) {
  const std::string csv = EncodeSummaryCsv(
      SummariesOf({RunOf("pmcr", "1", 1, 4, 1000, 1), RunOf("phs", "1", 1, 2, 1000, 8)}));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), ','), 3 * 24);
  EXPECT_NE(csv.find("\nphs,1,1,1000,0,8,0,,0,2,4,,2,0,,1,1,,,1,0.5,4,4,0.5,0.5\n"),
            std::string::npos)
      << csv;
}

TEST(BenchSummary, NoRunsNoSummary) { EXPECT_TRUE(SummariesOf({}).empty()); }

}  // namespace
}  // namespace lambert

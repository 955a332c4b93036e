#include "app/bench_list.h"

#include <algorithm>

#include "app/exit.h"
#include "gtest/gtest.h"

namespace lambert::app {
namespace {

std::vector<std::string> Labels(const std::vector<BenchEntry>& entries) {
  std::vector<std::string> labels;
  for (const BenchEntry& entry : entries) labels.push_back(entry.label);
  return labels;
}

std::string Bad(const std::vector<std::string>& written) {
  const auto entries = ParseBenchEntries(written, {});
  EXPECT_EQ(ExitCodeFor(entries.status()), ExitCode::kUsage) << written.front();
  return std::string(entries.status().message());
}

TEST(BenchEntries, AnEntrySetsTheOptionsOfItsMethod) {
  const auto entries = ParseBenchEntries(
      {"pmcr", "phs:initial=5:depth=1:sampling=solid-angle:without=black+clusters"}, {});
  ASSERT_TRUE(entries.ok()) << entries.status();
  ASSERT_EQ(entries->size(), 2u);
  EXPECT_EQ((*entries)[0].solve.shoot.method, Method::kPmcr);
  const BenchEntry& phs = (*entries)[1];
  EXPECT_EQ(phs.label, "phs:initial=5:depth=1:sampling=solid-angle:without=black+clusters");
  EXPECT_TRUE(phs.by_name);
  EXPECT_EQ(phs.solve.shoot.method, Method::kPhs);
  EXPECT_EQ(phs.solve.shoot.pyramids.initial, 5);
  EXPECT_EQ(phs.solve.shoot.pyramids.depth, 1);
  EXPECT_EQ(phs.solve.shoot.pyramids.sampling, PyramidSampling::kSolidAngle);
  EXPECT_TRUE(phs.solve.shoot.parts.without.Has(Part::kClusters));
}

TEST(BenchEntries, WhatAnEntryLeavesOpenComesFromTheBenchsOwnOptions) {
  SolveOptions base;
  base.shoot.pyramids.initial = 7;
  const auto entries = ParseBenchEntries({"phs:depth=1"}, base);
  ASSERT_TRUE(entries.ok()) << entries.status();
  EXPECT_EQ((*entries)[0].solve.shoot.pyramids.initial, 7);
  EXPECT_EQ((*entries)[0].solve.shoot.pyramids.split, PyramidOptions().split);
}

TEST(BenchEntries, AllAreThoseOfTheLibraryAndNotAskedForByName) {
  std::vector<std::string> names;
  for (Method method : AllMethods()) names.push_back(MethodName(method));
  EXPECT_EQ(std::count(names.begin(), names.end(), "auto"), 0);
  const auto entries = ParseBenchEntries({}, {});
  ASSERT_TRUE(entries.ok());
  EXPECT_EQ(Labels(*entries), names);
  for (const BenchEntry& entry : *entries) EXPECT_FALSE(entry.by_name);
  const auto with_one_more = ParseBenchEntries({"pmcr", "all", "phs:depth=3"}, {});
  ASSERT_TRUE(with_one_more.ok());
  EXPECT_EQ(with_one_more->size(), names.size() + 1);
  EXPECT_TRUE((*with_one_more)[0].by_name);
}

TEST(BenchEntries, MistakesNameTheChoices) {
  EXPECT_EQ(Bad({"radiance"}).find("--methods radiance: there is no method 'radiance'; choose one"),
            0u);
  EXPECT_NE(Bad({"radiance"}).find("mcr, pmcr, hs97"), std::string::npos);
  EXPECT_NE(
      Bad({"phs:dept=3"}).find("no setting 'dept'; choose one of allocation, alpha1, alpha2, "),
      std::string::npos);
  EXPECT_NE(Bad({"phs:seed=3"}).find("no setting 'seed'"), std::string::npos);
  EXPECT_NE(Bad({"pmcr:depth=3"}).find("no setting 'depth'"), std::string::npos);
  EXPECT_NE(Bad({"phs:depth=9"}).find("9 gives too many"), std::string::npos);
  EXPECT_NE(Bad({"phs:sampling=x"}).find("'x' is not projected|solid-angle"), std::string::npos);
  EXPECT_NE(Bad({"phs:depth"}).find("--methods phs:depth: "), std::string::npos);
  EXPECT_NE(Bad({"pmcr:sequence=x"}).find("random|sobol"), std::string::npos);
  EXPECT_NE(Bad({"importance"}).find("name a node with --region"), std::string::npos);
  EXPECT_NE(Bad({"phs:"}).find("no setting ''"), std::string::npos);
  EXPECT_NE(Bad({""}).find("there is no method ''"), std::string::npos);
  EXPECT_NE(Bad({"phs", "phs"}).find("stands there twice"), std::string::npos);
  EXPECT_NE(Bad({"phs:initial=64:depth=4:split=4:alpha1=0:alpha2=0"}).find("both zero"),
            std::string::npos);
}

TEST(BenchBudgets, AreRaysOrSeconds) {
  EXPECT_EQ(ParseBenchBudget("200k")->rays, 200'000);
  EXPECT_EQ(ParseBenchBudget("2e5")->rays, 200'000);
  EXPECT_EQ(ParseBenchBudget("1.5s")->seconds, 1.5);
  EXPECT_EQ(ParseBenchBudget("1.5s")->rays, 0);
  EXPECT_EQ(BudgetText({200'000, 0}), "200000");
  EXPECT_EQ(BudgetText({0, 1.5}), "1.5s");
  for (const char* text : {"", "0", "-1", "0s", "s", "x", "1.5", "1e400", "nans", "5x"}) {
    EXPECT_EQ(ExitCodeFor(ParseBenchBudget(text).status()), ExitCode::kUsage) << text;
  }
}

TEST(BenchBudgets, WithoutAListAreStepsUpToTheLargest) {
  Options options;
  EXPECT_EQ(BenchBudgets(options).size(), 5u);
  EXPECT_EQ(BenchBudgets(options).back().rays, kDefaultBenchRays);
  options.solve.max_rays = 100;
  EXPECT_EQ(BenchBudgets(options).front().rays, 4);
  options.solve.max_rays = 0;
  options.solve.max_time_s = 10;
  EXPECT_EQ(BenchBudgets(options).front().seconds, 0.4);
  EXPECT_EQ(BenchBudgets(options).back().seconds, 10);
  options.bench.budgets = {{7, 0}};
  EXPECT_EQ(BenchBudgets(options).size(), 1u);
}

TEST(BenchBudgets, ABudgetIsTheOnlyStopRule) {
  SolveOptions base;
  base.max_error = 0.1;
  base.max_rays = 5;
  const SolveOptions solve = WithBudget(base, {0, 2}, 9);
  EXPECT_EQ(solve.max_error, 0);
  EXPECT_EQ(solve.max_rays, 0);
  EXPECT_EQ(solve.max_time_s, 2);
  EXPECT_EQ(solve.seed, 9u);
}

}  // namespace
}  // namespace lambert::app

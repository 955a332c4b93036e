#include "server/work/grain_runs.h"

#include <gtest/gtest.h>

#include <vector>

namespace lambert::server {
namespace {

TEST(GrainRuns, BeginAtHomeAndGoOnWithTheFirstOfAll) {
  GrainRuns runs(10);
  EXPECT_EQ(runs.From(6), (GrainRange{6, 4}));
  runs.Take({6, 4});
  EXPECT_EQ(runs.From(6), (GrainRange{0, 6}));
  EXPECT_EQ(runs.From(2), (GrainRange{2, 4}));
}

TEST(GrainRuns, TakingCutsARunInTwoOrMakesItShorter) {
  GrainRuns runs(10);
  runs.Take({4, 2});
  EXPECT_EQ(runs.runs(), (std::vector<GrainRange>{{0, 4}, {6, 4}}));
  EXPECT_EQ(runs.From(4), (GrainRange{6, 4}));
  runs.Take({6, 1});
  runs.Take({3, 1});
  EXPECT_EQ(runs.runs(), (std::vector<GrainRange>{{0, 3}, {7, 3}}));
  EXPECT_EQ(runs.count(), 6);
}

TEST(GrainRuns, HoldEachGrainOnce) {
  GrainRuns runs(20);
  std::vector<int> taken(20);
  for (int home = 0; runs.count() > 0; home = (home + 7) % 20) {
    const GrainRange range{runs.From(home).first, 1};
    ++taken[range.first];
    runs.Take(range);
  }
  EXPECT_EQ(taken, std::vector<int>(20, 1));
  EXPECT_TRUE(runs.runs().empty());
  EXPECT_EQ(GrainRuns(0).count(), 0);
}

}  // namespace
}  // namespace lambert::server

// A crowd at one server: what it needs stays bounded.
#include "tests/distributed/crowd.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

constexpr int kWorkers = 64, kWatchers = 100;
constexpr int kManySquares = 10;  // 3,200 patches
constexpr int64_t kFewRays = 10'000'000, kManyRays = 3'000'000'000;
// Of connections, calls, and what a watcher has of one message.
constexpr int64_t kBoundKiB = int64_t{128} << 10;

TEST(Crowd, DoesNotGrowTheCoordinatorsMemoryPastABound) {
  Farm farm;
  const StubWorkers workers(farm.address(), kWorkers);
  EXPECT_TRUE(farm.Watch(farm.CreateJob(kFewRays, "", kManySquares, "pmcr").name()).status.ok());
  const int64_t before = StatusKiB(farm.server().id(), "VmRSS");
  const v1::SolveJob job = farm.CreateJob(kManyRays, "", kManySquares, "pmcr");
  const IdleWatchers watchers(farm.address(), job.name(), kWatchers);
  EXPECT_EQ(farm.Watch(job.name()).ended.state(), v1::SolveJob::STATE_SUCCEEDED);
  const int64_t grown = StatusKiB(farm.server().id(), "VmHWM") - before;
  RecordProperty("grown_kib", std::to_string(grown));
  EXPECT_LT(grown, kBoundKiB);
}

}  // namespace
}  // namespace lambert

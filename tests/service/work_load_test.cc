#include "server/work/work_load.h"

#include <gtest/gtest.h>

namespace lambert::server {
namespace {

TEST(WorkLoad, CountsWhatNobodyHoldsAtThePaceOfItsJob) {
  WorkState state;
  AddSession(state, "a", "", 3, {});
  AddSession(state, "b", "", 2, {});
  AddStep(state, "known", 1, std::vector<int64_t>(5, 1000));
  AddStep(state, "new", 2, {500'000});
  state.paces["known"].seconds_per_ray.median = 1e-3;
  AddLease(state, {"known", CutUnit(state, "known", {0, 2})}, "a", "a/leases/1", TimePoint());
  const WorkLoad load = LoadOf(state);
  EXPECT_EQ(load.queued_rays, 3 * 1000 + 500'000);
  EXPECT_DOUBLE_EQ(load.queued_seconds, 3.0 + 0.5);
  EXPECT_EQ(load.leases, 1);
  EXPECT_EQ(load.workers, 2);
  EXPECT_EQ(load.slots, 5);
}

TEST(WorkLoad, AUnitThatOpensAgainIsInTheQueueAgain) {
  WorkState state;
  AddSession(state, "a", "", 1, {});
  AddStep(state, "job", 1, {1000, 1000});
  AddLease(state, {"job", CutUnit(state, "job", {0, 2})}, "a", "a/leases/1", TimePoint());
  EXPECT_EQ(LoadOf(state).queued_rays, 0);
  RemoveLease(state, "a/leases/1", /*failed=*/true);
  EXPECT_EQ(LoadOf(state).queued_rays, 2000);
}

}  // namespace
}  // namespace lambert::server

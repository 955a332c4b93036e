#include "server/work/next_leases.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace lambert::server {
namespace {

constexpr int64_t kRays = 1000;
const TimePoint kNow = TimePoint() + std::chrono::hours(1);

void AddWaiting(WorkState& state, const std::string& name, int slots) {
  state.sessions[name].slots = slots;
  state.sessions[name].waiting = true;
}

void AddUnits(WorkState& state, const std::string& job, int count) {
  AddStep(state, job, 1, std::vector<int64_t>(count, kRays));
}

int GrantsOf(const std::vector<Grant>& grants, const std::string& session) {
  return static_cast<int>(std::count_if(
      grants.begin(), grants.end(), [&](const Grant& grant) { return grant.session == session; }));
}

TEST(NextLeases, EqualViewsGiveEqualGrants) {
  WorkState state;
  AddWaiting(state, "a", 3);
  AddWaiting(state, "b", 2);
  AddUnits(state, "job", 7);
  EXPECT_EQ(NextLeases(state, kNow, {}), NextLeases(state, kNow, {}));
}

TEST(NextLeases, FewUnitsGoToAsManyWorkersAsThereAre) {
  WorkState state;
  AddWaiting(state, "a", 4);
  AddWaiting(state, "b", 4);
  AddUnits(state, "job", 2);
  const std::vector<Grant> grants = NextLeases(state, kNow, {});
  EXPECT_EQ(GrantsOf(grants, "a"), 1);
  EXPECT_EQ(GrantsOf(grants, "b"), 1);
}

TEST(NextLeases, ManyUnitsFillSlotsAndAsManyLieReady) {
  WorkState state;
  AddWaiting(state, "a", 2);
  AddWaiting(state, "b", 1);
  AddUnits(state, "job", 20);
  const std::vector<Grant> grants = NextLeases(state, kNow, {});
  EXPECT_EQ(GrantsOf(grants, "a"), 4);
  EXPECT_EQ(GrantsOf(grants, "b"), 2);
}

TEST(NextLeases, NoUnitIsGrantedTwiceAtOnce) {
  WorkState state;
  AddWaiting(state, "a", 3);
  AddWaiting(state, "b", 3);
  AddUnits(state, "job", 8);
  int grains = 0;
  for (const Grant& grant : NextLeases(state, kNow, {})) grains += grant.new_grains;
  EXPECT_EQ(grains, 8);
}

TEST(NextLeases, UnitsShrinkTowardsTheEndOfAStep) {
  WorkState state;
  AddWaiting(state, "a", 1);
  AddWaiting(state, "b", 1);
  AddUnits(state, "job", 32);
  std::vector<int> sizes;
  for (const Grant& grant : NextLeases(state, kNow, {})) sizes.push_back(grant.new_grains);
  EXPECT_EQ(sizes, (std::vector<int>{8, 6, 4, 3}));
}

TEST(NextLeases, GrainsThatAreLargeEnoughAreLentOneByOne) {
  WorkState state;
  AddWaiting(state, "a", 1);
  WorkOptions options;
  options.max_unit_rays = 2 * kRays - 1;
  AddUnits(state, "job", 32);
  for (const Grant& grant : NextLeases(state, kNow, options)) EXPECT_EQ(grant.new_grains, 1);
}

TEST(NextLeases, NothingIsGrantedAheadWhileAnotherWorkerWithAFreeSlotIsOnItsWay) {
  WorkState state;
  AddWaiting(state, "a", 1);
  AddWaiting(state, "b", 1);
  state.sessions["b"].waiting = false;
  AddUnits(state, "job", 2);
  EXPECT_EQ(NextLeases(state, kNow, {}).size(), 1u);
  AddStep(state, "other", 2, {kRays, kRays});
  EXPECT_EQ(NextLeases(state, kNow, {}).size(), 2u);
}

TEST(NextLeases, DrainingWorkersGetNothing) {
  WorkState state;
  AddWaiting(state, "a", 2);
  state.sessions["a"].draining = true;
  AddUnits(state, "job", 2);
  EXPECT_TRUE(NextLeases(state, kNow, {}).empty());
}

TEST(NextLeases, JobsTakeTurns) {
  WorkState state;
  AddWaiting(state, "a", 4);
  AddUnits(state, "first", 10);
  AddUnits(state, "second", 10);
  const std::vector<Grant> grants = NextLeases(state, kNow, {});
  const auto of_first = std::count_if(grants.begin(), grants.end(),
                                      [](const Grant& grant) { return grant.job == "first"; });
  EXPECT_EQ(grants.size(), 8u);
  EXPECT_EQ(of_first, 4);
}

class FailedUnit : public testing::Test {
 protected:
  FailedUnit() {
    AddWaiting(state_, "weak", 1);
    AddWaiting(state_, "strong", 1);
    state_.sessions["strong"].waiting = false;
    AddUnits(state_, "job", 1);
    CutUnit(state_, "job", 1);
    AddLease(state_, {"job", 0}, "weak", "lease", kNow);
    LetRest(state_, "lease", kNow, options_);
    RemoveLease(state_, "lease", /*failed=*/true);
  }
  std::vector<Grant> GrantsAfterRest() {
    return NextLeases(state_, kNow + options_.first_rest, options_);
  }
  const WorkOptions options_;
  WorkState state_;
};

TEST_F(FailedUnit, WaitsForAWorkerOnWhichItDidNotFail) {
  EXPECT_TRUE(GrantsAfterRest().empty());
  state_.sessions["strong"].waiting = true;
  EXPECT_EQ(GrantsAfterRest(), (std::vector<Grant>{{"strong", "job", 0, 0}}));
}

TEST_F(FailedUnit, IsTriedAgainWhereItFailedWhenThereIsNobodyElse) {
  state_.sessions["strong"].draining = true;
  EXPECT_EQ(GrantsAfterRest(), (std::vector<Grant>{{"weak", "job", 0, 0}}));
}

TEST_F(FailedUnit, LeavesItsWorkerARestThatGrowsAndOneUnitAtATime) {
  AddUnits(state_, "other", 9);
  EXPECT_TRUE(NextLeases(state_, kNow + options_.first_rest / 2, options_).empty());
  EXPECT_EQ(GrantsAfterRest().size(), 1u);
  for (const Duration expected : {2 * options_.first_rest, 4 * options_.first_rest}) {
    AddLease(state_, {"job", 0}, "weak", "lease", kNow);
    LetRest(state_, "lease", kNow, options_);
    RemoveLease(state_, "lease", /*failed=*/true);
    EXPECT_EQ(state_.sessions["weak"].rests_until, kNow + expected);
  }
}

TEST(Pace, IsTheMedianAndDeafToOneFrozenWorker) {
  WorkState state;
  AddUnits(state, "job", 3);
  for (double seconds : {1.0, 1000.0, 2.0}) {
    FinishUnit(state, {"job", CutUnit(state, "job", 1)}, "digest", "w", seconds);
  }
  EXPECT_DOUBLE_EQ(state.paces["job"].median, 2.0 / kRays);
}

class LateUnit : public testing::Test {
 protected:
  LateUnit() {
    AddWaiting(state_, "frozen", 1);
    AddWaiting(state_, "idle", 1);
    state_.sessions["frozen"].waiting = false;
    AddUnits(state_, "job", 1);
    CutUnit(state_, "job", 1);
    AddLease(state_, {"job", 0}, "frozen", "frozen/leases/1", kNow);
    state_.paces["job"].median = 1e-3;  // the unit should take a second
  }
  WorkState state_;
};

TEST_F(LateUnit, IsRepeatedElsewhereAfterTwiceItsTime) {
  EXPECT_TRUE(NextLeases(state_, kNow + std::chrono::milliseconds(1999), {}).empty());
  EXPECT_EQ(NextLeases(state_, kNow + std::chrono::milliseconds(2000), {}),
            (std::vector<Grant>{{"idle", "job", 0, 0}}));
}

TEST_F(LateUnit, IsNeverRepeatedOnTheWorkerThatHoldsIt) {
  state_.sessions["idle"].waiting = false;
  state_.sessions["frozen"].waiting = true;
  state_.sessions["frozen"].slots = 4;
  EXPECT_TRUE(NextLeases(state_, kNow + std::chrono::hours(1), {}).empty());
}

TEST_F(LateUnit, WaitsForAFixedTimeWhileThePaceIsUnknown) {
  state_.paces.clear();
  const WorkOptions options;
  EXPECT_TRUE(NextLeases(state_, kNow + options.straggler_unknown / 2, options).empty());
  EXPECT_EQ(NextLeases(state_, kNow + options.straggler_unknown, options).size(), 1u);
}

TEST_F(LateUnit, GetsAThirdLeaseOnlyAfterTheSecondIsLateToo) {
  AddLease(state_, {"job", 0}, "idle", "idle/leases/2", kNow + std::chrono::seconds(2));
  AddWaiting(state_, "third", 1);
  EXPECT_TRUE(NextLeases(state_, kNow + std::chrono::seconds(3), {}).empty());
  EXPECT_EQ(NextLeases(state_, kNow + std::chrono::seconds(4), {}).size(), 1u);
}

TEST(WorkState, AUnitWhoseOnlyLeaseEndsOpensAgainAsTheNext) {
  WorkState state;
  AddWaiting(state, "a", 1);
  AddUnits(state, "job", 3);
  for (int i = 0; i < 3; ++i) CutUnit(state, "job", 1);
  AddLease(state, {"job", 2}, "a", "lease", kNow);
  RemoveLease(state, "lease", /*failed=*/true);
  EXPECT_EQ(state.steps["job"].open.front(), 2);
  EXPECT_EQ(state.steps["job"].units[2].attempts, 1);
  EXPECT_TRUE(state.sessions["a"].leases.empty());
}

TEST(WorkState, ARevokedLeaseFillsItsSlotUntilItIsRemoved) {
  WorkState state;
  AddWaiting(state, "a", 1);
  AddUnits(state, "job", 1);
  CutUnit(state, "job", 1);
  AddLease(state, {"job", 0}, "a", "lease", kNow);
  RemoveStep(state, "job");
  EXPECT_EQ(state.sessions["a"].FreeSlots(), 0);
  RemoveLease(state, "lease", false);
  EXPECT_EQ(state.sessions["a"].FreeSlots(), 1);
  EXPECT_TRUE(state.leases.empty());
}

}  // namespace
}  // namespace lambert::server

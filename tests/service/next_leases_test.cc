#include "server/work/next_leases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace lambert::server {
namespace {

constexpr int64_t kRays = 1000;
const TimePoint kNow = TimePoint() + std::chrono::hours(1);

void AddWaiting(WorkState& state, const std::string& name, int slots) {
  AddSession(state, name, "worker of " + name, slots, {});
  SetWaiting(state, name, true);
}

void AddUnits(WorkState& state, const std::string& job, int count) {
  AddStep(state, job, 1, std::vector<int64_t>(count, kRays));
}

// Makes the first grains that are left a unit.
int CutNext(WorkState& state, int count) {
  return CutUnit(state, "job", {state.steps.at("job").uncut.From(0).first, count});
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
  for (const Grant& grant : NextLeases(state, kNow, {})) grains += grant.new_grains.count;
  EXPECT_EQ(grains, 8);
}

TEST(NextLeases, UnitsShrinkTowardsTheEndOfAStep) {
  WorkState state;
  AddWaiting(state, "a", 1);
  AddWaiting(state, "b", 1);
  AddUnits(state, "job", 32);
  std::vector<int> sizes;
  for (const Grant& grant : NextLeases(state, kNow, {})) sizes.push_back(grant.new_grains.count);
  EXPECT_EQ(sizes, (std::vector<int>{8, 6, 4, 3}));
}

TEST(NextLeases, GrainsThatAreLargeEnoughAreLentOneByOne) {
  WorkState state;
  AddWaiting(state, "a", 1);
  WorkOptions options;
  options.max_unit_rays = 2 * kRays - 1;
  AddUnits(state, "job", 32);
  for (const Grant& grant : NextLeases(state, kNow, options)) EXPECT_EQ(grant.new_grains.count, 1);
}

TEST(NextLeases, NothingIsGrantedAheadWhileAnotherWorkerWithAFreeSlotIsOnItsWay) {
  WorkState state;
  AddWaiting(state, "a", 1);
  AddWaiting(state, "b", 1);
  SetWaiting(state, "b", false);
  AddUnits(state, "job", 2);
  EXPECT_EQ(NextLeases(state, kNow, {}).size(), 1u);
  AddStep(state, "other", 2, {kRays, kRays});
  EXPECT_EQ(NextLeases(state, kNow, {}).size(), 2u);
}

TEST(NextLeases, DrainingWorkersGetNothing) {
  WorkState state;
  AddWaiting(state, "a", 2);
  SetDraining(state, "a", true);
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

// Workers w0, w1, ... of one slot each.
WorkState FarmOf(int workers) {
  WorkState state;
  for (int i = 0; i < workers; ++i) AddWaiting(state, "w" + std::to_string(i), 1);
  return state;
}

std::set<std::string> SessionsOf(const std::vector<Grant>& grants) {
  std::set<std::string> sessions;
  for (const Grant& grant : grants) sessions.insert(grant.session);
  return sessions;
}

// The time of a step on P workers, in seconds of a link that carries a sum of all patches in one.
double StepTime(double rays_per_patch, int workers, int mergers, const WorkOptions& options) {
  return rays_per_patch / options.rays_per_sum / workers + static_cast<double>(workers) / mergers;
}

TEST(MostSessions, IsWhereTracingAndSendingTakeLeast) {
  const WorkOptions options;
  const WorkState state = FarmOf(1000);
  StepState step;
  step.sums = {100, 4};
  for (const int64_t rays : {100, 1000, 10'000, 100'000}) {
    step.rays = rays;
    const int most = MostSessions(step, state.roster, options);
    const double k = static_cast<double>(rays) / 100;
    EXPECT_LT(StepTime(k, most, 4, options), StepTime(k, 2 * most, 4, options));
    EXPECT_GT(most, 1);
    EXPECT_LT(StepTime(k, most, 4, options), StepTime(k, most / 2, 4, options));
  }
}

TEST(NextLeases, AStepOfFewRaysAPatchStaysWithFewWorkers) {
  WorkState state = FarmOf(10);
  WorkOptions options;
  options.rays_per_sum = 1;
  AddStep(state, "job", 1, std::vector<int64_t>(40, kRays), {10 * kRays, 1});  // 4 rays a patch
  const std::vector<Grant> grants = NextLeases(state, kNow, options);
  EXPECT_EQ(grants.size(), 4u);  // two workers, of one slot and a unit that lies ready
  EXPECT_EQ(SessionsOf(grants).size(), 2u);
  for (const Grant& grant : grants) {
    AddLease(state, {"job", CutUnit(state, "job", grant.new_grains)}, grant.session,
             "lease" + std::to_string(state.leases.size()), kNow);
  }
  EXPECT_TRUE(NextLeases(state, kNow, options).empty());
  RemoveLease(state, "lease0", false);  // whoever holds some gets more
  EXPECT_EQ(SessionsOf(NextLeases(state, kNow, options)),
            (std::set<std::string>{grants[0].session}));
}

TEST(NextLeases, StepsThatHaveEnoughWorkersLeaveTheOthersToOtherJobs) {
  WorkState state = FarmOf(10);
  WorkOptions options;
  options.rays_per_sum = 1;
  AddStep(state, "thin", 1, std::vector<int64_t>(40, kRays), {10 * kRays, 1});
  AddStep(state, "thick", 2, std::vector<int64_t>(400, kRays), {kRays, 1});
  EXPECT_EQ(SessionsOf(NextLeases(state, kNow, options)).size(), 10u);
}

TEST(Roster, FollowsEveryChange) {
  WorkState state;
  AddWaiting(state, "a", 2);
  AddWaiting(state, "b", 1);
  EXPECT_EQ(state.roster.slots, 3);
  EXPECT_EQ(state.roster.takers, (std::set<std::string>{"a", "b"}));
  AddUnits(state, "job", 4);
  for (const char* lease : {"1", "2"}) {
    AddLease(state, {"job", CutNext(state, 1)}, "b", lease, kNow);
  }
  EXPECT_EQ(state.roster.takers, (std::set<std::string>{"a"}));  // b holds all that it may
  SetWaiting(state, "a", false);
  EXPECT_TRUE(state.roster.takers.empty());
  EXPECT_EQ(state.roster.free_elsewhere, 2);
  SetDraining(state, "a", true);
  EXPECT_EQ(state.roster.free_elsewhere, 0);
  EXPECT_EQ(state.roster.sessions, 1);
  FinishUnit(state, {"job", 0}, "digest", "b", 1, 1);
  EXPECT_EQ(state.revoked, (std::vector<std::string>{"1"}));
  RemoveLease(state, "1", false);
  EXPECT_EQ(state.roster.takers, (std::set<std::string>{"b"}));
  RemoveSession(state, "a");
  EXPECT_EQ(state.roster.slots, 1);
}

class FailedUnit : public testing::Test {
 protected:
  FailedUnit() {
    AddWaiting(state_, "weak", 1);
    AddWaiting(state_, "strong", 1);
    SetWaiting(state_, "strong", false);
    AddUnits(state_, "job", 1);
    CutNext(state_, 1);
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
  SetWaiting(state_, "strong", true);
  EXPECT_EQ(GrantsAfterRest(), (std::vector<Grant>{{"strong", "job", 0, {}}}));
}

TEST_F(FailedUnit, IsTriedAgainWhereItFailedWhenThereIsNobodyElse) {
  SetDraining(state_, "strong", true);
  EXPECT_EQ(GrantsAfterRest(), (std::vector<Grant>{{"weak", "job", 0, {}}}));
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
    FinishUnit(state, {"job", CutNext(state, 1)}, "digest", "w", seconds, seconds);
  }
  EXPECT_DOUBLE_EQ(state.paces["job"].seconds_per_ray.median, 2.0 / kRays);
}

class LateUnit : public testing::Test {
 protected:
  LateUnit() {
    AddWaiting(state_, "frozen", 4);
    AddWaiting(state_, "idle", 1);
    SetWaiting(state_, "frozen", false);
    AddUnits(state_, "job", 1);
    CutNext(state_, 1);
    AddLease(state_, {"job", 0}, "frozen", "frozen/leases/1", kNow);
    state_.paces["job"].seconds_per_ray.median = 1e-3;  // the unit should take a second
  }
  WorkState state_;
};

TEST_F(LateUnit, IsRepeatedElsewhereAfterTwiceItsTime) {
  EXPECT_TRUE(RepeatLate(state_, kNow + std::chrono::milliseconds(1999), {}).empty());
  EXPECT_EQ(RepeatLate(state_, kNow + std::chrono::milliseconds(2000), {}),
            (std::vector<Grant>{{"idle", "job", 0, {}}}));
}

TEST_F(LateUnit, HasTheTimeThatOthersWaitedBesides) {
  state_.paces["job"].wait_s.median = 3;
  EXPECT_TRUE(RepeatLate(state_, kNow + std::chrono::milliseconds(7999), {}).empty());
  EXPECT_EQ(RepeatLate(state_, kNow + std::chrono::seconds(8), {}).size(), 1u);
}

TEST_F(LateUnit, IsNeverRepeatedOnTheWorkerThatHoldsIt) {
  SetWaiting(state_, "idle", false);
  SetWaiting(state_, "frozen", true);
  EXPECT_TRUE(RepeatLate(state_, kNow + std::chrono::hours(1), {}).empty());
}

TEST_F(LateUnit, WaitsForAFixedTimeWhileThePaceIsUnknown) {
  state_.paces.clear();
  const WorkOptions options;
  EXPECT_TRUE(RepeatLate(state_, kNow + options.straggler_unknown / 2, options).empty());
  EXPECT_EQ(RepeatLate(state_, kNow + options.straggler_unknown, options).size(), 1u);
}

TEST_F(LateUnit, GetsAThirdLeaseOnlyAfterTheSecondIsLateToo) {
  AddLease(state_, {"job", 0}, "idle", "idle/leases/2", kNow + std::chrono::seconds(2));
  AddWaiting(state_, "third", 1);
  EXPECT_TRUE(RepeatLate(state_, kNow + std::chrono::seconds(3), {}).empty());
  EXPECT_EQ(RepeatLate(state_, kNow + std::chrono::seconds(4), {}).size(), 1u);
}

TEST(WorkState, AUnitWhoseOnlyLeaseEndsOpensAgainAsTheNext) {
  WorkState state;
  AddWaiting(state, "a", 1);
  AddUnits(state, "job", 3);
  for (int i = 0; i < 3; ++i) CutNext(state, 1);
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
  CutNext(state, 1);
  AddLease(state, {"job", 0}, "a", "lease", kNow);
  RemoveStep(state, "job");
  EXPECT_EQ(state.sessions["a"].FreeSlots(), 0);
  RemoveLease(state, "lease", false);
  EXPECT_EQ(state.sessions["a"].FreeSlots(), 1);
  EXPECT_TRUE(state.leases.empty());
}

}  // namespace
}  // namespace lambert::server

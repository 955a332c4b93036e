// A result of several units: all of them are merged, or none.
#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "tests/service/work_fakes.h"

namespace lambert::server {
namespace {

class CombinedResult : public testing::Test {
 protected:
  // Each unit is one grain.
  void SetUp() override {
    worker_.Sync();
    step_ = *table_.Publish(MakeSetup("job"), MakeUnits(3));
    ASSERT_EQ(worker_.leases.size(), 3u);
  }

  FakeClock clock_;
  WorkTable table_{WorkOptions(), "v1", 1000, clock_.clock()};
  FakeWorker worker_{&table_, "w", 3};
  std::shared_ptr<PublishedStep> step_;
};

TEST_F(CombinedResult, EndsAStepWithTheSumOfItsUnits) {
  EXPECT_EQ(*table_.Submit(Combine(worker_.leases)), SubmitOutcome::kAccepted);
  const absl::StatusOr<UnitResult> merged = step_->Wait();
  ASSERT_TRUE(merged.ok());
  EXPECT_EQ(merged->rays, 3 * kFakeRays);
  EXPECT_EQ(merged->deposits[0].r, 15);
  EXPECT_EQ(table_.ListWorkers()[0].finished_units, 3);
  EXPECT_EQ(table_.ListWorkers()[0].leases, 0);
}

TEST_F(CombinedResult, IsADuplicateWhenItComesAgain) {
  const Submission two = Combine({worker_.leases[0], worker_.leases[2]});
  EXPECT_EQ(*table_.Submit(two), SubmitOutcome::kAccepted);
  EXPECT_EQ(*table_.Submit(two), SubmitOutcome::kDuplicate);
}

TEST_F(CombinedResult, IsSplitWhereSomeOfItsUnitsHaveAResult) {
  EXPECT_EQ(*worker_.Submit(worker_.leases[1]), SubmitOutcome::kAccepted);
  EXPECT_EQ(*table_.Submit(Combine(worker_.leases)), SubmitOutcome::kSplit);
  EXPECT_EQ(*worker_.Submit(worker_.leases[0]), SubmitOutcome::kAccepted);
  EXPECT_EQ(*worker_.Submit(worker_.leases[1]), SubmitOutcome::kDuplicate);
  EXPECT_EQ(*worker_.Submit(worker_.leases[2]), SubmitOutcome::kAccepted);
  EXPECT_EQ(step_->Wait()->deposits[0].r, 15);
}

TEST_F(CombinedResult, StillTellsWhoComputesAUnitDifferently) {
  EXPECT_EQ(*table_.Submit(Combine({worker_.leases[0], worker_.leases[1]})),
            SubmitOutcome::kAccepted);
  FakeWorker faulty(&table_, "faulty");
  const GrantedLease& lease = worker_.leases[1];
  EXPECT_EQ(*faulty.Submit({"", lease.step, lease.unit}), SubmitOutcome::kDuplicate);
  const auto different = faulty.Submit({"", lease.step, lease.unit}, MakeResult(3));
  EXPECT_EQ(ReasonOf(different.status()), "NONDETERMINISTIC_RESULT");
}

TEST_F(CombinedResult, WhoseLedgerDoesNotBalanceIsRefusedAndAllItsUnitsOpenAgain) {
  UnitResult forged = MakeResult();
  forged.deposits[0].r += 1;
  EXPECT_EQ(ReasonOf(table_.Submit(Combine(worker_.leases, forged)).status()), "RESULT_INVALID");
  FakeWorker other(&table_, "other", 3);
  other.Sync();
  EXPECT_EQ(other.leases.size(), 3u);
}

TEST_F(CombinedResult, NamesNoUnitTwice) {
  const Submission twice = Combine({worker_.leases[0], worker_.leases[0]});
  EXPECT_EQ(ReasonOf(table_.Submit(twice).status()), "FIELD_INVALID");
}

}  // namespace
}  // namespace lambert::server

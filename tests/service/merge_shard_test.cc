// A merge shard adds each unit's part once, and tells when a step is whole.
#include "server/merge/merge_shard.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "radiosity/shoot/result_range.h"

namespace lambert::server {
namespace {

class MergeShardTest : public testing::Test {
 protected:
  // Three units of ten rays; the shard has patches 2 to 3 of 6.
  MergeShardTest() {
    shard_.Open();
    shard_.SetSteps({Step(7)});
  }
  static MergeStep Step(int64_t number) { return {"solveJobs/j", number, 30, 6, 2, 4, false}; }
  static Part Of(const std::vector<int>& units, PatchIndex patch = 2, int64_t rays = 10) {
    Part part{7, {}, ""};
    UnitResult sum;
    sum.deposits = {{static_cast<int64_t>(units.size()), 0, 0, 1, patch}};
    for (const int unit : units) part.units.push_back({unit, rays});
    part.bytes = EncodeUnitResult(sum);
    return part;
  }
  std::string Submit(const Part& part) {
    const absl::StatusOr<PartOutcome> outcome = shard_.Submit(part);
    if (!outcome.ok()) return ReasonOf(outcome.status());
    return *outcome == PartOutcome::kAccepted    ? "accepted"
           : *outcome == PartOutcome::kDuplicate ? "duplicate"
                                                 : "split";
  }

  MergeShard shard_;
};

TEST_F(MergeShardTest, SumsEachUnitOnce) {
  EXPECT_EQ(Submit(Of({0, 2})), "accepted");
  EXPECT_EQ(Submit(Of({0, 2})), "duplicate");
  EXPECT_EQ(Submit(Of({2})), "duplicate");
  EXPECT_EQ(Submit(Of({0, 1})), "split");
  EXPECT_EQ(Submit(Of({1})), "accepted");
  const std::optional<MergedRange> whole = shard_.TakeWhole();
  ASSERT_TRUE(whole.has_value());
  EXPECT_EQ(whole->step.number, 7);
  const absl::StatusOr<UnitResult> sum = DecodeUnitResult(whole->bytes, 6);
  ASSERT_TRUE(sum.ok());
  ASSERT_EQ(sum->deposits.size(), 1u);
  EXPECT_EQ(sum->deposits[0].r, 3);
  EXPECT_EQ(sum->deposits[0].hits, 2);
  EXPECT_TRUE(IsRange(*sum, 2, 4));
  EXPECT_EQ(Submit(Of({1})), "duplicate");
}

TEST_F(MergeShardTest, RefusesWhatIsNoPart) {
  EXPECT_EQ(Submit(Of({0}, 1)), "RESULT_INVALID");
  EXPECT_EQ(Submit(Of({0}, 4)), "RESULT_INVALID");
  EXPECT_EQ(Submit(Of({})), "RESULT_INVALID");
  EXPECT_EQ(Submit(Of({0, 0})), "RESULT_INVALID");
  EXPECT_EQ(Submit(Of({-1})), "RESULT_INVALID");
  EXPECT_EQ(Submit(Of({0}, 2, 31)), "RESULT_INVALID");
  EXPECT_EQ(Submit(Of({0}, 2, 0)), "RESULT_INVALID");
  Part garbage = Of({0});
  garbage.bytes = "garbage";
  EXPECT_EQ(Submit(garbage), "RESULT_INVALID");
  EXPECT_EQ(Submit(Of({0, 1}, 2, 15)), "accepted");
  EXPECT_EQ(Submit(Of({2})), "RESULT_INVALID");  // the step has no more rays
}

TEST_F(MergeShardTest, ForgetsStepsThatAreOver) {
  EXPECT_EQ(Submit(Of({0})), "accepted");
  EXPECT_GT(*shard_.MaxPartBytes(7), 0);
  shard_.SetSteps({Step(8)});
  EXPECT_FALSE(shard_.Takes(7));
  EXPECT_EQ(shard_.step_count(), 1);
  EXPECT_EQ(Submit(Of({0})), "STEP_UNKNOWN");
  EXPECT_EQ(ReasonOf(shard_.MaxPartBytes(9).status()), "STEP_UNKNOWN");
  shard_.Close();
  EXPECT_FALSE(shard_.TakeWhole().has_value());
}

}  // namespace
}  // namespace lambert::server

// The coordinator's merge shards: who takes which patches, and what is done when one goes.
#include "server/work/shard_table.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "radiosity/shoot/result_range.h"
#include "server/run/table_executor.h"
#include "tests/service/work_fakes.h"

#include <thread>

namespace lambert::server {
namespace {

WorkOptions Options() {
  WorkOptions options;
  options.least_shard_patches = 1;
  return options;
}

// Talks to a table as a shard does.
class FakeShard {
 public:
  FakeShard(WorkTable* table, const std::string& name) : table_(table), name_(name) { Sync(); }
  void Sync(bool draining = false, const std::string& version = "v1") {
    const int64_t seen = orders.empty() || !orders.back().ok() ? 0 : orders.back()->version;
    table_->shards().Sync({name_, name_ + ":1", version, seen, draining}, this,
                          [this](absl::StatusOr<ShardOrders> reply) { orders.push_back(reply); });
  }
  absl::StatusOr<bool> Send(const UnitResult& sum, int64_t step) {
    return table_->shards().TakeRange(name_, step, EncodeUnitResult(sum));
  }
  std::vector<absl::StatusOr<ShardOrders>> orders;

 private:
  WorkTable* const table_;
  const std::string name_;
};

class ShardTableTest : public testing::Test {
 protected:
  // A worker hands back the ledger of a unit; all parts are taken to be at the shards.
  void SubmitLedgers() {
    for (const GrantedLease& lease : worker_.leases) {
      if (lease.step->number() != worker_.leases.back().step->number()) continue;
      EXPECT_TRUE(worker_.Submit(lease, LedgerOf(MakeResult())).ok());
    }
  }
  UnitResult SumOf(int units, PatchIndex first, PatchIndex end) {
    UnitResult sum;
    for (int i = 0; i < units; ++i) MergeResult(RangeOf(MakeResult(), first, end), sum);
    return sum;
  }

  FakeClock clock_;
  WorkTable table_{Options(), "v1", 1000, clock_.clock()};
  FakeWorker worker_{&table_, "w", 3};
};

TEST_F(ShardTableTest, AStepOfFewerRaysThanPatchesNeedsNoShards) {
  FakeShard a(&table_, "a");
  WorkSetup setup = MakeSetup("job");
  const std::vector<WorkUnit> units = MakeUnits(3);
  setup.patch_count = static_cast<PatchIndex>(3 * units[0].RayCount());
  EXPECT_EQ((*table_.Publish(setup, units))->shards().size(), 1u);
  table_.Withdraw("job");
  ++setup.patch_count;
  EXPECT_TRUE((*table_.Publish(setup, units))->shards().empty());
}

TEST_F(ShardTableTest, DividesThePatchesAmongThoseThatAreThere) {
  EXPECT_TRUE(table_.shards().Divide(100).empty());
  FakeShard a(&table_, "a"), b(&table_, "b"), c(&table_, "c");
  c.Sync(/*draining=*/true);
  const std::vector<ShardRange> ranges = table_.shards().Divide(101);
  ASSERT_EQ(ranges.size(), 2u);
  EXPECT_EQ(ranges[0].first, 0);
  EXPECT_EQ(ranges[0].end, ranges[1].first);
  EXPECT_EQ(ranges[1].end, 101);
  EXPECT_EQ(table_.shards().Divide(1).size(), 1u);
  EXPECT_EQ(table_.shards().shard_count(), 3);
}

TEST_F(ShardTableTest, AStepIsWholeWithItsLedgersAndItsSums) {
  FakeShard a(&table_, "a"), b(&table_, "b");
  const auto step = *table_.Publish(MakeSetup("job"), MakeUnits(3));
  a.Sync();
  ASSERT_EQ(a.orders.back()->orders.size(), 1u);
  EXPECT_EQ(a.orders.back()->orders[0].end, 1);
  worker_.Sync();
  ASSERT_EQ(worker_.leases.size(), 3u);
  EXPECT_TRUE(*a.Send(SumOf(3, 0, 1), step->number()));
  SubmitLedgers();
  EXPECT_TRUE(step->WaitsForShards());
  EXPECT_TRUE(step->WaitsFor("b"));
  EXPECT_TRUE(*b.Send(SumOf(3, 1, 2), step->number()));
  const absl::StatusOr<UnitResult> merged = step->Wait();
  ASSERT_TRUE(merged.ok()) << merged.status();
  EXPECT_EQ(merged->deposits[0].r, 15);
  EXPECT_EQ(merged->deposits[1].r, 3);
  EXPECT_EQ(merged->rays, 3 * kFakeRays);
  table_.Withdraw("job");
  EXPECT_FALSE(*b.Send(SumOf(3, 1, 2), step->number()));
  EXPECT_EQ(table_.shards().MaxRangeBytes(step->number()), 0);
}

TEST_F(ShardTableTest, RefusesLedgersThatCannotBe) {
  FakeShard a(&table_, "a");
  const auto step = *table_.Publish(MakeSetup("job"), MakeUnits(1));
  worker_.Sync();
  UnitResult ledger = LedgerOf(MakeResult());
  ledger.escaped[1] = ledger.shot[1] + 1;
  EXPECT_EQ(ReasonOf(worker_.Submit(worker_.leases[0], ledger).status()), "RESULT_INVALID");
}

TEST_F(ShardTableTest, SumsThatDoNotFitTheLedgersAreNotBelieved) {
  FakeShard a(&table_, "a");
  const auto step = *table_.Publish(MakeSetup("job"), MakeUnits(1));
  worker_.Sync();
  SubmitLedgers();
  EXPECT_TRUE(*a.Send(SumOf(2, 0, 2), step->number()));
  EXPECT_EQ(ReasonOf(step->Wait().status()), "SHARD_FAILED");
}

TEST_F(ShardTableTest, ASumOfOtherPatchesEndsTheStep) {
  FakeShard a(&table_, "a"), b(&table_, "b");
  const auto step = *table_.Publish(MakeSetup("job"), MakeUnits(1));
  EXPECT_EQ(ReasonOf(a.Send(SumOf(1, 1, 2), step->number()).status()), "RESULT_INVALID");
  EXPECT_EQ(ReasonOf(step->Wait().status()), "SHARD_FAILED");
}

TEST_F(ShardTableTest, AShardThatFallsSilentFailsTheStepsThatWaitForIt) {
  FakeShard a(&table_, "a"), b(&table_, "b");
  const auto step = *table_.Publish(MakeSetup("job"), MakeUnits(1));
  clock_.Advance(std::chrono::seconds(9));
  a.Sync();
  clock_.Advance(std::chrono::seconds(2));
  table_.Tick();
  EXPECT_EQ(table_.shards().shard_count(), 1);
  EXPECT_EQ(ReasonOf(step->Wait().status()), "SHARD_FAILED");
}

TEST_F(ShardTableTest, AnotherShardAtTheAddressTakesItsPlace) {
  FakeShard a(&table_, "a");
  const auto step = *table_.Publish(MakeSetup("job"), MakeUnits(1));
  table_.shards().Sync({"new", "a:1", "v1", 0, false}, this, [](const auto&) {});
  EXPECT_EQ(ReasonOf(step->Wait().status()), "SHARD_FAILED");
  EXPECT_EQ(table_.shards().shard_count(), 1);
}

TEST_F(ShardTableTest, SumsThatDoNotComeAreGivenUp) {
  FakeShard a(&table_, "a");
  const auto step = *table_.Publish(MakeSetup("job"), MakeUnits(1));
  worker_.Sync();
  SubmitLedgers();
  for (int second = 0; second < 40; ++second) {
    a.Sync();
    table_.Tick();
    clock_.Advance(std::chrono::seconds(1));
  }
  EXPECT_EQ(ReasonOf(step->Wait().status()), "SHARD_FAILED");
}

TEST_F(ShardTableTest, AnswersAtOnceWhereThereIsNewsAndHoldsElse) {
  FakeShard a(&table_, "a");
  EXPECT_EQ(a.orders.size(), 1u);
  a.Sync();
  EXPECT_EQ(a.orders.size(), 1u);
  a.Sync();
  ASSERT_EQ(a.orders.size(), 2u);
  EXPECT_EQ(ReasonOf(a.orders[1].status()), "SYNC_REPLACED");
  (void)table_.Publish(MakeSetup("job"), MakeUnits(1));
  EXPECT_EQ(a.orders.back()->orders.size(), 1u);
  a.Sync();
  const size_t answers = a.orders.size();
  clock_.Advance(std::chrono::seconds(3));
  table_.Tick();
  EXPECT_EQ(a.orders.size(), answers + 1);
  a.Sync();
  table_.shards().CancelSync("a", &a);
  EXPECT_TRUE(absl::IsCancelled(a.orders.back().status()));
  a.Sync(false, "v2");
  EXPECT_EQ(ReasonOf(a.orders.back().status()), "UNIT_VERSION_UNSUPPORTED");
  a.Sync();  // is told of the step again
  a.Sync();
  table_.Shutdown();
  EXPECT_EQ(ReasonOf(a.orders.back().status()), "SHUTTING_DOWN");
  FakeShard none(&table_, "");
  EXPECT_EQ(ReasonOf(none.orders.back().status()), "SHUTTING_DOWN");
}

TEST_F(ShardTableTest, AStepThatLostItsShardIsShotAgainAndInTheEndWithoutShards) {
  TableExecutor executor(&table_, MakeSetup("job"));
  absl::StatusOr<UnitResult> result;
  std::vector<std::string> addresses;
  std::thread job([&] { result = executor.RunStep(MakeUnits(1)); });
  FakeShard shards[] = {{&table_, "a"}, {&table_, "b"}, {&table_, "c"}, {&table_, "d"}};
  size_t served = 0;
  while (true) {
    // The worker asks for what is there, so that it is answered in this thread.
    while (table_.Load().queued_rays == 0) std::this_thread::yield();
    worker_.Sync();
    if (worker_.leases.size() == served) continue;
    const GrantedLease lease = worker_.leases.back();
    served = worker_.leases.size();
    if (lease.step->shards().empty()) {
      EXPECT_TRUE(worker_.Submit(lease).ok());
      break;
    }
    // Its sum is no sum: a shard that fails.
    (void)table_.shards().TakeRange(lease.step->shards()[0].shard, lease.step->number(), "none");
  }
  job.join();
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->rays, kFakeRays);
}

}  // namespace
}  // namespace lambert::server

// Steps that outlast the process: what is found again, what is shot again, what goes.
#include "server/jobs/journal.h"

#include <gtest/gtest.h>

#include <chrono>

#include "radiosity/core/error.h"
#include "server/database/open_stores.h"
#include "server/database/sqlite_record_store.h"
#include "server/run/journal_executor.h"
#include "tests/support/temporary_folder.h"

namespace lambert::server {
namespace {

constexpr PatchIndex kPatches = 8;

std::vector<WorkUnit> Step(uint32_t pass, uint32_t step, uint32_t rays = 10) {
  WorkUnit unit;
  unit.pass = pass;
  unit.step = step;
  unit.visits.push_back({0, rays, 0, rays, {100, 0, 0}});
  return {unit};
}

UnitResult Result(int64_t rays) {
  UnitResult result;
  result.deposits.push_back({rays, 0, 0, rays, 3});
  result.shot = {rays, 0, 0};
  result.rays = rays;
  result.cpu_seconds = .5;
  return result;
}

// Counts the steps that are shot, each of which takes `seconds` on a clock of its own; looking at
// the clock takes a millisecond.
class CountingExecutor : public StepExecutor {
 public:
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override {
    ++shot;
    now += std::chrono::duration_cast<Duration>(std::chrono::duration<double>(seconds));
    return Result(units.front().RayCount());
  }
  Clock clock() {
    return [this] { return now += std::chrono::milliseconds(1); };
  }
  int shot = 0;
  double seconds = 1;
  TimePoint now{};
};

class JournalOf : public testing::Test {
 protected:
  JournalOf() { Restart(); }
  // As a server that is started again.
  void Restart() {
    journal.reset();
    refs.reset();
    stores = {};
    stores = *OpenStores({folder.path(), {}});
    refs = std::make_unique<BlobRefs>(stores.blobs.get(), std::chrono::hours(1), SteadyNow);
    journal =
        std::make_unique<Journal>("job", stores.blobs.get(), refs.get(), stores.records.get());
    ASSERT_TRUE(journal->Load().ok());
    store::v1::ResumePoint point;
    point.ParseFromString(stores.records->Load(kResumePoints, "job").value_or(""));
    for (const std::string& blob : BlobsOf(point)) refs->Add(blob);
  }
  absl::StatusOr<UnitResult> Run(const std::vector<WorkUnit>& units,
                                 JournalMode mode = JournalMode::kEvery) {
    JournalExecutor executor(&inner, journal.get(), mode, kPatches, inner.clock(),
                             [this](const std::string& line) { log += line + "\n"; });
    return executor.RunStep(units);
  }

  TemporaryFolder folder;
  Stores stores;
  std::unique_ptr<BlobRefs> refs;
  std::unique_ptr<Journal> journal;
  CountingExecutor inner;
  std::string log;
};

TEST_F(JournalOf, AnInterruptedRunAnswersFinishedSteps) {
  const UnitResult first = *Run(Step(0, 0));
  Run(Step(0, 1)).IgnoreError();
  Restart();
  EXPECT_EQ(*Run(Step(0, 0)), first);
  EXPECT_EQ(inner.shot, 2);
  Run(Step(0, 2)).IgnoreError();
  EXPECT_EQ(inner.shot, 3);
  EXPECT_NE(log.find("goes on at pass 0, step 2"), std::string::npos) << log;
}

// On this clock keeping a step takes a millisecond.
TEST_F(JournalOf, StepsThatTakeLittleMoreThanKeepingThemAreNotKeptButForTheFirst) {
  for (const auto& [seconds, summary] : {std::pair(.005, "kept 1 of 3 steps in 0.001000 s"),
                                         std::pair(.05, "kept 3 of 3 steps in 0.003000 s")}) {
    inner.seconds = seconds;
    JournalExecutor executor(&inner, journal.get(), JournalMode::kAuto, kPatches, inner.clock(),
                             [](const std::string&) {});
    const auto pass = static_cast<uint32_t>(seconds * 1000);
    for (uint32_t step = 0; step < 3; ++step) executor.RunStep(Step(pass, step)).IgnoreError();
    EXPECT_EQ(executor.Summary(), summary);
  }
}

TEST_F(JournalOf, AStepThatWasLeftOutIsShotAndThoseAfterItAreAnswered) {
  Run(Step(0, 0), JournalMode::kOff).IgnoreError();
  Run(Step(0, 1)).IgnoreError();
  Restart();
  for (uint32_t step = 0; step < 3; ++step) Run(Step(0, step)).IgnoreError();
  EXPECT_EQ(inner.shot, 4);
  EXPECT_EQ(log.find("goes on at pass 0, step 0"), std::string::npos) << log;
  EXPECT_NE(log.find("goes on at pass 0, step 2"), std::string::npos) << log;
}

TEST_F(JournalOf, OtherUnitsOfAStepAreShot) {
  Run(Step(0, 0, 10)).IgnoreError();
  Restart();
  EXPECT_EQ(Run(Step(0, 0, 11))->rays, 11);
  EXPECT_EQ(inner.shot, 2);
}

TEST_F(JournalOf, AResultThatIsLostIsShotAgain) {
  Run(Step(0, 0)).IgnoreError();
  for (const StoredBlob& blob : stores.blobs->List()) stores.blobs->Delete(blob.sha256);
  Restart();
  EXPECT_EQ(Run(Step(0, 0))->rays, 10);
  EXPECT_EQ(inner.shot, 2);
}

TEST_F(JournalOf, ACheckpointLeavesStepsBehindOnceItIsStored) {
  Run(Step(0, 0)).IgnoreError();
  absl::StatusOr<RecordChange> change = journal->Replace("state");
  ASSERT_TRUE(change.ok());
  Restart();  // between blob and transaction
  EXPECT_EQ(*journal->Checkpoint(), "");
  Run(Step(0, 0)).IgnoreError();
  EXPECT_EQ(inner.shot, 1);
  change = journal->Replace("state");
  ASSERT_TRUE(stores.records->Commit({*change}).ok());
  journal->Settle();
  EXPECT_EQ(stores.blobs->List().size(), 1u);
  Restart();
  EXPECT_EQ(*journal->Checkpoint(), "state");
  Run(Step(0, 0)).IgnoreError();
  EXPECT_EQ(inner.shot, 2);
}

TEST_F(JournalOf, AJobThatEndedLeavesNothing) {
  Run(Step(0, 0)).IgnoreError();
  ASSERT_TRUE(stores.records->Commit({*journal->Replace("state")}).ok());
  journal->Settle();
  Run(Step(1, 0)).IgnoreError();
  ASSERT_TRUE(stores.records->Commit({journal->Clear()}).ok());
  journal->Settle();
  EXPECT_TRUE(stores.blobs->List().empty());
  EXPECT_TRUE(stores.records->LoadAll(kResumePoints)->empty());
}

TEST_F(JournalOf, StepsThatAreNotToBeKeptAreShotAgain) {
  Run(Step(0, 0), JournalMode::kOff).IgnoreError();
  Restart();
  Run(Step(0, 0), JournalMode::kOff).IgnoreError();
  EXPECT_EQ(inner.shot, 2);
}

TEST_F(JournalOf, AnErrorOfTheStoreIsNoErrorOfTheStepButALostStoreIs) {
  auto successor = *OpenSqliteRecordStore(folder.path() + "/lambert.db");
  EXPECT_TRUE(IsOwnershipLost(Run(Step(0, 0)).status()));
}

TEST(JournalCost, IsInProportionToBytesAndForgottenInTheEnd) {
  JournalCost cost;
  EXPECT_EQ(cost.Expect(1), 0);
  cost.Learn(1 << 20, .1);
  EXPECT_DOUBLE_EQ(cost.Expect(2 << 20), .2);
  EXPECT_GT(cost.Expect(1), .01);  // waiting for the disk is never free
  cost.Learn(1 << 20, .3);
  EXPECT_DOUBLE_EQ(cost.Expect(1 << 20), .2);
  for (int i = 0; i < 1000; ++i) cost.Forget();
  EXPECT_LT(cost.Expect(1 << 20), 1e-4);
}

}  // namespace
}  // namespace lambert::server

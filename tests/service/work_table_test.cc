#include "server/work/work_table.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "tests/service/work_fakes.h"

namespace lambert::server {
namespace {

class WorkTableTest : public testing::Test {
 protected:
  std::shared_ptr<PublishedStep> Publish(int units, const std::string& job = "job") {
    return *table_.Publish(MakeSetup(job), MakeUnits(units));
  }

  FakeClock clock_;
  const WorkOptions options_;
  WorkTable table_{options_, "v1", 1000, clock_.clock()};
};

TEST_F(WorkTableTest, AStepEndsWithTheSumOfItsUnits) {
  FakeWorker worker(&table_, "w", 3);
  worker.Sync();
  auto step = Publish(3);
  ASSERT_EQ(worker.leases.size(), 3u);
  for (const GrantedLease& lease : std::vector<GrantedLease>(worker.leases)) {
    EXPECT_EQ(*worker.Submit(lease), SubmitOutcome::kAccepted);
  }
  absl::StatusOr<UnitResult> merged = step->Wait();
  ASSERT_TRUE(merged.ok());
  EXPECT_EQ(merged->rays, 3 * kFakeRays);
  EXPECT_EQ(merged->deposits[0].r, 15);
  EXPECT_EQ(merged->shot, (Quanta{21, 21, 21}));
  EXPECT_NEAR(merged->cpu_seconds, 0.03, 1e-12);
}

TEST_F(WorkTableTest, AHeldCallIsAnsweredTheMomentUnitsArePublished) {
  FakeWorker worker(&table_, "w");
  worker.Sync();
  EXPECT_TRUE(worker.replies.empty());
  Publish(1);
  ASSERT_EQ(worker.replies.size(), 1u);
  EXPECT_EQ(worker.replies[0]->leases.size(), 1u);
}

TEST_F(WorkTableTest, AHeldCallIsAnsweredEmptyAfterTheSyncInterval) {
  FakeWorker worker(&table_, "w");
  worker.Sync();
  clock_.Advance(options_.sync_interval - std::chrono::milliseconds(1));
  table_.Tick();
  EXPECT_TRUE(worker.replies.empty());
  clock_.Advance(std::chrono::milliseconds(1));
  table_.Tick();
  ASSERT_EQ(worker.replies.size(), 1u);
  EXPECT_TRUE(worker.replies[0]->leases.empty());
}

TEST_F(WorkTableTest, ARepeatedSequenceGetsTheSameLeases) {
  FakeWorker worker(&table_, "w", 2);
  Publish(2);
  worker.Sync();
  worker.Resend();
  ASSERT_EQ(worker.replies.size(), 2u);
  ASSERT_EQ(worker.replies[0]->leases.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(worker.replies[0]->leases[i].name, worker.replies[1]->leases[i].name);
  }
}

TEST_F(WorkTableTest, ARepeatedSequenceTakesOverWhileTheFirstCallWaits) {
  FakeWorker worker(&table_, "w");
  worker.Sync();
  worker.Resend();
  ASSERT_EQ(worker.replies.size(), 1u);
  EXPECT_EQ(ReasonOf(worker.replies[0].status()), "SYNC_REPLACED");
  Publish(1);
  ASSERT_EQ(worker.replies.size(), 2u);
  EXPECT_EQ(worker.replies[1]->leases.size(), 1u);
}

TEST_F(WorkTableTest, TheEndOfAReplacedCallDoesNotEndItsSuccessor) {
  FakeWorker worker(&table_, "w");
  SyncRequest request{worker.session(), 1, {}, false};
  int first = 0, second = 0, answers = 0;
  table_.Sync(request, &first, [](absl::StatusOr<SyncReply>) {});
  table_.Sync(request, &second, [&](absl::StatusOr<SyncReply> reply) { answers += reply.ok(); });
  table_.CancelSync(worker.session(), &first);
  Publish(1);
  EXPECT_EQ(answers, 1);
}

TEST_F(WorkTableTest, AnOldSequenceIsRefused) {
  FakeWorker worker(&table_, "w");
  Publish(1);
  worker.Sync();
  absl::Status status;
  table_.Sync({worker.session(), 0, {}, false}, nullptr,
              [&](absl::StatusOr<SyncReply> reply) { status = reply.status(); });
  EXPECT_EQ(ReasonOf(status), "SEQUENCE_STALE");
}

TEST_F(WorkTableTest, ALeaseThatIsNotReportedGoesToSomebodyElse) {
  FakeWorker forgetful(&table_, "forgetful"), other(&table_, "other");
  Publish(1);
  forgetful.Sync();
  ASSERT_EQ(forgetful.leases.size(), 1u);
  forgetful.Forget(forgetful.leases[0].name);
  other.Sync();
  EXPECT_TRUE(other.leases.empty());
  forgetful.Drain();
  forgetful.Sync();
  EXPECT_EQ(other.leases.size(), 1u);
}

TEST_F(WorkTableTest, ASilentWorkerLosesItsLeasesToAnother) {
  FakeWorker silent(&table_, "silent"), other(&table_, "other");
  Publish(1);
  silent.Sync();
  clock_.Advance(options_.session_expiry + std::chrono::milliseconds(1));
  other.Sync();
  table_.Tick();
  EXPECT_EQ(other.leases.size(), 1u);
  silent.Sync();
  EXPECT_EQ(ReasonOf(silent.replies.back().status()), "SESSION_NOT_FOUND");
}

TEST_F(WorkTableTest, ALateResultOfALostSessionIsWelcome) {
  FakeWorker silent(&table_, "silent");
  auto step = Publish(1);
  silent.Sync();
  clock_.Advance(options_.session_expiry * 2);
  table_.Tick();
  EXPECT_EQ(*silent.Submit(silent.leases[0]), SubmitOutcome::kAccepted);
  EXPECT_TRUE(step->Wait().ok());
}

TEST_F(WorkTableTest, TheFirstResultCountsAndTheSecondIsADuplicate) {
  FakeWorker slow(&table_, "slow"), fast(&table_, "fast");
  auto step = Publish(2);
  slow.Sync();
  clock_.Advance(options_.straggler_unknown);
  fast.Sync();
  fast.Sync();
  fast.Sync();
  ASSERT_GE(fast.leases.size(), 1u);
  const GrantedLease lease = slow.leases[0];
  EXPECT_EQ(*fast.Submit({"", lease.step, lease.unit}), SubmitOutcome::kAccepted);
  EXPECT_EQ(*slow.Submit(lease), SubmitOutcome::kDuplicate);
  table_.Withdraw("job");
}

TEST_F(WorkTableTest, AResultAfterTheStepIsObsolete) {
  FakeWorker worker(&table_, "w");
  Publish(1);
  worker.Sync();
  table_.Withdraw("job");
  EXPECT_EQ(*worker.Submit(worker.leases[0]), SubmitOutcome::kObsolete);
}

TEST_F(WorkTableTest, AResultOfTheStepBeforeIsNotTakenForTheNext) {
  FakeWorker worker(&table_, "w");
  Publish(1);
  worker.Sync();
  table_.Withdraw("job");
  auto next = Publish(1);
  EXPECT_EQ(*worker.Submit(worker.leases[0]), SubmitOutcome::kObsolete);
  next->Abort(absl::CancelledError("nothing was merged"));
  EXPECT_TRUE(absl::IsCancelled(next->Wait().status()));
}

TEST_F(WorkTableTest, TwoDifferentResultsFailTheStepAndNameBothWorkers) {
  FakeWorker sound(&table_, "sound"), faulty(&table_, "faulty");
  auto step = Publish(2);
  sound.Sync();
  faulty.Sync();
  const GrantedLease lease = sound.leases[0];
  EXPECT_TRUE(sound.Submit(lease).ok());
  const auto second = faulty.Submit({faulty.leases[0].name, lease.step, lease.unit}, MakeResult(3));
  EXPECT_EQ(ReasonOf(second.status()), "NONDETERMINISTIC_RESULT");
  const absl::Status status = step->Wait().status();
  EXPECT_EQ(ReasonOf(status), "NONDETERMINISTIC_RESULT");
  EXPECT_NE(status.message().find("sound"), absl::string_view::npos);
  EXPECT_NE(status.message().find("faulty"), absl::string_view::npos);
}

TEST_F(WorkTableTest, AResultWhoseLedgerDoesNotBalanceIsRefusedAndTheUnitOpensAgain) {
  FakeWorker faulty(&table_, "faulty"), other(&table_, "other");
  auto step = Publish(1);
  faulty.Sync();
  UnitResult forged = MakeResult();
  forged.deposits[0].r += 1;
  const auto refused = faulty.Submit(faulty.leases[0], forged);
  EXPECT_EQ(ReasonOf(refused.status()), "RESULT_INVALID");
  EXPECT_NE(refused.status().message().find("faulty"), absl::string_view::npos);
  other.Sync();
  ASSERT_EQ(other.leases.size(), 1u);
  EXPECT_EQ(*other.Submit(other.leases[0]), SubmitOutcome::kAccepted);
  EXPECT_EQ(step->Wait()->deposits[0].r, 5);
}

TEST_F(WorkTableTest, BytesThatAreNoResultAreRefused) {
  FakeWorker worker(&table_, "w");
  Publish(1);
  worker.Sync();
  Submission submission = MakeSubmission(worker.leases[0], MakeResult());
  submission.bytes = "not a result";
  EXPECT_EQ(ReasonOf(table_.Submit(submission).status()), "RESULT_INVALID");
  submission.units[0].unit = 99;
  EXPECT_EQ(ReasonOf(table_.Submit(submission).status()), "FIELD_INVALID");
}

TEST_F(WorkTableTest, AUnitThatFailsFiveTimesFailsTheStepAndSaysWhy) {
  FakeWorker worker(&table_, "w");
  auto step = Publish(1);
  worker.Sync();
  for (int attempt = 0; attempt < options_.max_attempts; ++attempt) {
    ASSERT_EQ(worker.leases.size(), static_cast<size_t>(attempt + 1));
    worker.Fail(worker.leases.back().name, "out of memory");
    worker.Sync();
    clock_.Advance(options_.longest_rest);
    worker.Sync();
  }
  const absl::Status status = step->Wait().status();
  EXPECT_EQ(ReasonOf(status), "UNIT_ATTEMPTS_EXHAUSTED");
  EXPECT_NE(status.message().find("out of memory"), absl::string_view::npos);
}

TEST_F(WorkTableTest, ClosingASessionIsNoAttempt) {
  auto step = Publish(1);
  for (int i = 0; i < 2 * options_.max_attempts; ++i) {
    FakeWorker worker(&table_, std::to_string(i));
    worker.Sync();
    ASSERT_EQ(worker.leases.size(), 1u);
    table_.CloseSession(worker.session());
  }
  FakeWorker last(&table_, "last");
  last.Sync();
  EXPECT_EQ(*last.Submit(last.leases[0]), SubmitOutcome::kAccepted);
  EXPECT_TRUE(step->Wait().ok());
}

TEST_F(WorkTableTest, AFrozenWorkersUnitIsRepeatedLongBeforeItsSessionExpires) {
  FakeWorker frozen(&table_, "frozen"), idle(&table_, "idle");
  auto step = Publish(2);
  frozen.Sync();
  idle.Sync();
  ASSERT_EQ(idle.leases.size(), 1u);
  EXPECT_EQ(*idle.Submit(idle.leases[0]), SubmitOutcome::kAccepted);  // 0.01 s: the pace
  idle.Sync();
  clock_.Advance(options_.straggler_floor);
  table_.Tick();
  ASSERT_EQ(idle.leases.size(), 2u);
  EXPECT_EQ(*idle.Submit(idle.leases[1]), SubmitOutcome::kAccepted);
  EXPECT_TRUE(step->Wait().ok());
}

TEST_F(WorkTableTest, ALeaseWhoseUnitIsDoneIsRevoked) {
  FakeWorker slow(&table_, "slow"), fast(&table_, "fast");
  Publish(1);
  slow.Sync();
  slow.Sync();  // held: nothing more to do
  EXPECT_TRUE(fast.Submit({"", slow.leases[0].step, slow.leases[0].unit}).ok());
  EXPECT_EQ(slow.revoked, (std::vector<std::string>{slow.leases[0].name}));
}

TEST_F(WorkTableTest, ADrainingWorkerGetsNoMoreWork) {
  FakeWorker worker(&table_, "w");
  worker.Drain();
  worker.Sync();
  Publish(1);
  EXPECT_TRUE(worker.leases.empty());
}

TEST_F(WorkTableTest, AnotherUnitVersionGetsNoSession) {
  EXPECT_EQ(ReasonOf(table_.OpenSession("w", 1, "v2").status()), "UNIT_VERSION_UNSUPPORTED");
}

TEST_F(WorkTableTest, WorkersWithoutANameOrSlotsGetNoSession) {
  EXPECT_EQ(ReasonOf(table_.OpenSession("", 1, "v1").status()), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(table_.OpenSession("w", 0, "v1").status()), "FIELD_INVALID");
  EXPECT_EQ(ReasonOf(table_.OpenSession("w", 1 << 20, "v1").status()), "FIELD_INVALID");
}

TEST_F(WorkTableTest, AWorkerThatStartsAgainLosesItsOldSession) {
  FakeWorker before(&table_, "w"), other(&table_, "other");
  Publish(1);
  before.Sync();
  other.Sync();
  FakeWorker after(&table_, "w");
  EXPECT_EQ(other.leases.size(), 1u);
  before.Sync();
  EXPECT_EQ(ReasonOf(before.replies.back().status()), "SESSION_NOT_FOUND");
  EXPECT_EQ(table_.ListWorkers().size(), 2u);
}

TEST_F(WorkTableTest, AnAbortedJobPublishesNoMoreUntilItIsForgotten) {
  auto step = Publish(1);
  table_.AbortJob("job", absl::CancelledError("enough"));
  EXPECT_TRUE(absl::IsCancelled(step->Wait().status()));
  table_.Withdraw("job");
  EXPECT_TRUE(absl::IsCancelled(table_.Publish(MakeSetup("job"), MakeUnits(1)).status()));
  table_.ForgetJob("job");
  EXPECT_TRUE(table_.Publish(MakeSetup("job"), MakeUnits(1)).ok());
}

TEST_F(WorkTableTest, ShutdownEndsStepsAndHeldCalls) {
  FakeWorker worker(&table_, "w");
  worker.Sync();
  auto step = Publish(1);
  worker.Sync();
  table_.Shutdown();
  EXPECT_EQ(ReasonOf(worker.replies.back().status()), "SHUTTING_DOWN");
  EXPECT_EQ(ReasonOf(step->Wait().status()), "SHUTTING_DOWN");
  EXPECT_EQ(ReasonOf(table_.Publish(MakeSetup("job"), MakeUnits(1)).status()), "SHUTTING_DOWN");
}

TEST_F(WorkTableTest, WorkersAreListedWithWhatTheyDid) {
  FakeWorker worker(&table_, "w", 2);
  Publish(2);
  worker.Sync();
  EXPECT_TRUE(worker.Submit(worker.leases[0]).ok());
  clock_.Advance(std::chrono::seconds(1));
  const std::vector<WorkerInfo> workers = table_.ListWorkers();
  ASSERT_EQ(workers.size(), 1u);
  EXPECT_EQ(workers[0].worker_id, "w");
  EXPECT_EQ(workers[0].slots, 2);
  EXPECT_EQ(workers[0].leases, 1);
  EXPECT_EQ(workers[0].finished_units, 1);
  EXPECT_DOUBLE_EQ(workers[0].silence_s, 1);
}

}  // namespace
}  // namespace lambert::server

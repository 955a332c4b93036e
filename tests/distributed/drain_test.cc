// SIGTERM, and workers that come and go in the middle of a step.
#include <gtest/gtest.h>

#include "tests/distributed/farm.h"
#include "tests/distributed/same_bytes.h"

namespace lambert {
namespace {

constexpr int kKilledBySigterm = 128 + SIGTERM;
constexpr int64_t kManyRays = 20'000'000;  // whose first steps are of many units each

const std::string& ExpectedOfMany() {
  static const std::string bytes = SolveSerially(Method::kPmcr, kManyRays);
  return bytes;
}

TEST(Draining, AWorkerThatLeavesInTheMiddleOfAStepChangesNoByte) {
  Farm farm;
  for (int i = 0; i < 2; ++i) farm.AddWorker(2);
  const v1::SolveJob job = farm.CreateJob(kManyRays, "", kSquares, "pmcr");
  ASSERT_TRUE(farm.WaitUntilItHasAUnit(0, job.name()));
  farm.worker(0).Signal(SIGTERM);
  EXPECT_EQ(farm.worker(0).Wait(), 0);
  EXPECT_FALSE(farm.Listed(0).has_value());
  ExpectSameBytes(farm.Watch(job.name()), ExpectedOfMany());
}

TEST(Draining, WorkersThatJoinInTheMiddleOfAStepChangeNoByte) {
  Farm farm;
  farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kManyRays, "", kSquares, "pmcr");
  ASSERT_TRUE(farm.WaitUntilItHasAUnit(0, job.name()));
  for (int i = 0; i < 3; ++i) farm.AddWorker(2);
  EXPECT_TRUE(farm.WaitUntilItHasAUnit(3, job.name()));
  ExpectSameBytes(farm.Watch(job.name()), ExpectedOfMany());
}

TEST(Draining, AServerKeepsItsJobsAndTellsWatchersToComeAgain) {
  TemporaryFolder folder;
  Farm farm({"--data", folder.path()});
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kManyRays, "", kSquares, "pmcr");
  grpc::ClientContext context;
  v1::WatchSnapshotsRequest request;
  request.set_parent(job.name());
  auto watch = farm.snapshots()->WatchSnapshots(&context, request);
  ASSERT_TRUE(farm.WaitUntilItHasAUnit(0, job.name()));
  farm.server().Signal(SIGTERM);
  EXPECT_EQ(farm.RestartServer(), 0);
  v1::WatchSnapshotsResponse news;
  while (watch->Read(&news)) EXPECT_FALSE(news.has_job_ended());
  const grpc::Status status = watch->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAVAILABLE);
  EXPECT_EQ(ReasonOf(status), "SHUTTING_DOWN");
  ExpectSameBytes(farm.Watch(job.name()), ExpectedOfMany());
}

// A unit of the exact method is a whole pass: of so many rays it takes hours.
TEST(Draining, ASecondSignalEndsTheWorkerAndTheServerAtOnce) {
  Farm farm;
  farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(int64_t{1} << 40, "", kSquares, "exact");
  ASSERT_TRUE(farm.WaitUntilItHasAUnit(0, job.name()));
  for (Process* program : {&farm.worker(0), &farm.server()}) {
    program->Signal(SIGTERM);
    EXPECT_NE(program->WaitForError("a second signal ends this at once"), std::string::npos);
    program->Signal(SIGTERM);
    EXPECT_EQ(program->Wait(), kKilledBySigterm);
  }
}

}  // namespace
}  // namespace lambert

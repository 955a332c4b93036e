// Workers that are frozen for longer than their session lasts, or have too little memory.
#include <gtest/gtest.h>

#include "tests/distributed/farm.h"
#include "tests/distributed/same_bytes.h"

namespace lambert {
namespace {

constexpr int64_t kManyRays = 10'000'000;
constexpr int kManySquares = 120;                       // 460,800 patches of 149 bytes: 69 MB
constexpr int64_t kTooLittleBytes = int64_t{60} << 20;  // for them

TEST(FrozenWorker, LosesItsSessionAndItsLateResultChangesNoByte) {
  Farm farm({"--worker-timeout", "0.5"});
  farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kManyRays, "", kSquares, "pmcr");
  ASSERT_TRUE(farm.WaitUntilItHasAUnit(0, job.name()));
  farm.worker(0).Signal(SIGSTOP);
  ASSERT_TRUE(farm.WaitUntilListed(0, false, job.name()));
  farm.worker(0).Signal(SIGCONT);
  farm.AddWorker();
  ExpectSameBytes(farm.Watch(job.name()), SolveSerially(Method::kPmcr, kManyRays));
  EXPECT_NE(farm.worker(0).error().find("the session has ended"), std::string::npos);
}

TEST(WorkerWithoutMemory, SaysSoAndTheJobFailsWithUnitAndWorker) {
  Farm farm;
  farm.AddWorkerWithoutMemory(kTooLittleBytes);
  const v1::SolveJob ended =
      farm.Watch(farm.CreateJob(kRays, "", kManySquares, "pmcr").name()).ended;
  ASSERT_EQ(ended.state(), v1::SolveJob::STATE_FAILED);
  google::rpc::ErrorInfo info;
  ASSERT_TRUE(ended.error().details(0).UnpackTo(&info));
  EXPECT_EQ(info.reason(), "UNIT_ATTEMPTS_EXHAUSTED");
  const std::string& message = ended.error().message();
  for (const char* part : {"unit ", "worker-0", "not enough memory"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  EXPECT_NE(farm.worker(0).error().find("memory"), std::string::npos);
}

TEST(WorkerWithoutMemory, LeavesItsUnitsToOthers) {
  Farm farm;
  farm.AddWorkerWithoutMemory(kTooLittleBytes);
  farm.AddWorker();
  farm.worker(1).WaitForError("at work");
  const v1::SolveJob ended =
      farm.Watch(farm.CreateJob(kRays, "", kManySquares, "pmcr").name()).ended;
  EXPECT_EQ(ended.state(), v1::SolveJob::STATE_SUCCEEDED) << ended.error().message();
}

}  // namespace
}  // namespace lambert

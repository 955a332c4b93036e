// However many workers there are and whatever becomes of them, the solution has the bytes of the
// loop that runs in one thread without a network.
#include <gtest/gtest.h>

#include <algorithm>

#include "local/local_service.h"
#include "tests/distributed/farm.h"
#include "tests/distributed/same_bytes.h"

namespace lambert {
namespace {

struct Crew {
  int workers, slots;
};

class SameBytes : public testing::TestWithParam<Crew> {};

TEST_P(SameBytes, WithAnyNumberOfWorkersAndSlots) {
  Farm farm;
  for (int i = 0; i < GetParam().workers; ++i) farm.AddWorker(GetParam().slots);
  ExpectSameBytes(farm.Watch(farm.CreateJob(kRays, "", kSquares).name()));
}

INSTANTIATE_TEST_SUITE_P(Crews, SameBytes,
                         testing::Values(Crew{1, 1}, Crew{2, 1}, Crew{7, 1}, Crew{1, 2}, Crew{1, 3},
                                         Crew{2, 4}),
                         [](const auto& info) {
                           return std::to_string(info.param.workers) + "Workers" +
                                  std::to_string(info.param.slots) + "Slots";
                         });

TEST(SameBytesLocally, WithTheWholeServiceInThisProcess) {
  for (LocalServiceOptions options : {LocalServiceOptions{1, 1}, LocalServiceOptions{2, 2}}) {
    auto service = *LocalService::Start(options);
    ServiceCalls calls;
    calls.Connect(service->channel());
    ExpectSameBytes(calls.Watch(calls.CreateJob(kRays, "", kSquares).name()));
    calls.Connect(nullptr);
  }
}

// A unit of the exact method is a whole pass: more workers than units, and none may be missed.
TEST(SameBytesOfExact, WithAnyNumberOfWorkersAndOneKilled) {
  const std::string expected = SolveSerially(Method::kExact);
  for (const int workers : {1, 2, 5}) {
    Farm farm;
    for (int i = 0; i < workers; ++i) farm.AddWorker();
    const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares, "exact");
    if (workers > 1) {
      farm.WaitUntilUnderWay(job.name());
      farm.worker(0).Signal(SIGKILL);
    }
    ExpectSameBytes(farm.Watch(job.name()), expected);
  }
}

// The other methods, of which some keep statistics: two workers, and one of three killed.
class SameBytesOfMethod : public testing::TestWithParam<Method> {};

TEST_P(SameBytesOfMethod, WithTwoWorkersAndWithOneOfThreeKilled) {
  const std::string expected = SolveSerially(GetParam());
  for (const int workers : {2, 3}) {
    Farm farm;
    for (int i = 0; i < workers; ++i) farm.AddWorker();
    const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares, MethodName(GetParam()));
    if (workers == 3) {
      farm.WaitUntilUnderWay(job.name());
      farm.worker(0).Signal(SIGKILL);
    }
    ExpectSameBytes(farm.Watch(job.name()), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(Others, SameBytesOfMethod,
                         testing::Values(Method::kMcr, Method::kHs97, Method::kHs98, Method::kPhs,
                                         Method::kPhsAlpha, Method::kPhsAdaptive, Method::kPhsHier,
                                         Method::kImportance, Method::kWalk),
                         [](const auto& info) {
                           std::string name = MethodName(info.param);
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

TEST(SameBytesInTrouble, WithAWorkerKilledInTheMiddle) {
  Farm farm;
  for (int i = 0; i < 3; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.worker(0).Signal(SIGKILL);
  ExpectSameBytes(farm.Watch(job.name()));
}

TEST(SameBytesInTrouble, WithAWorkerFrozenInTheMiddle) {
  Farm farm;
  for (int i = 0; i < 3; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.worker(0).Signal(SIGSTOP);
  ExpectSameBytes(farm.Watch(job.name()));
}

TEST(SameBytesInTrouble, WithAWorkerThatThawsAndSendsOldResults) {
  Farm farm;
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.worker(0).Signal(SIGSTOP);
  farm.WaitUntilUnderWay(job.name(), 4);
  farm.worker(0).Signal(SIGCONT);
  ExpectSameBytes(farm.Watch(job.name()));
}

TEST(SameBytesInTrouble, WithAWorkerThatLeavesAndOneThatComesLate) {
  Farm farm;
  farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.worker(0).Signal(SIGTERM);
  EXPECT_EQ(farm.worker(0).Wait(), 0);
  farm.AddWorker();
  ExpectSameBytes(farm.Watch(job.name()));
}

TEST(SameBytesInTrouble, WithTheServerKilledAndStartedAgain) {
  TemporaryFolder folder;
  Farm farm({"--data", folder.path()});
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name(), 3);
  farm.KillAndRestartServer();
  ExpectSameBytes(farm.Watch(job.name()));
}

TEST(SameBytesInTrouble, WithTheDiskFullInTheMiddleAndRoomAfterARestart) {
  TemporaryFolder folder;
  Farm farm({"--data", folder.path()});
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.FillDisk();
  const v1::SolveJob failed = farm.Watch(job.name()).ended;
  ASSERT_EQ(failed.state(), v1::SolveJob::STATE_FAILED);
  EXPECT_NE(failed.error().message().find("give the server more disk"), std::string::npos);
  // There was no room to write down that it failed, either.
  farm.KillAndRestartServer();
  ExpectSameBytes(farm.Watch(job.name()));
}

}  // namespace
}  // namespace lambert

// The programs' own promises: signals, exit codes, wrong use, a full disk.
#include <gtest/gtest.h>

#include "tests/distributed/farm.h"

namespace lambert {
namespace {

TEST(Programs, LeaveWithZeroOnSigterm) {
  Farm farm;
  farm.AddWorker();
  farm.worker(0).WaitForError("at work");
  farm.worker(0).Signal(SIGTERM);
  EXPECT_EQ(farm.worker(0).Wait(), 0);
  farm.server().Signal(SIGTERM);
  EXPECT_EQ(farm.server().Wait(), 0);
}

TEST(Programs, StopInTheMiddleOfAJob) {
  Farm farm;
  farm.AddWorker();
  farm.WaitUntilUnderWay(farm.CreateJob(int64_t{1} << 50).name());
  farm.server().Signal(SIGTERM);
  EXPECT_EQ(farm.server().Wait(), 0);
  farm.worker(0).Signal(SIGTERM);
  EXPECT_EQ(farm.worker(0).Wait(), 0);
}

TEST(Programs, AWorkerWaitsForItsServer) {
  Process worker({LAMBERT_WORKER, "--server", "127.0.0.1:1"});
  EXPECT_NE(worker.WaitForError("no session yet"), std::string::npos);
  worker.Signal(SIGTERM);
  EXPECT_EQ(worker.Wait(), 0);
}

TEST(Programs, AWorkerFollowsTheAddressFileFromServerToServer) {
  TemporaryFolder folder;
  const std::string file = folder.path() + "/address";
  Process worker({LAMBERT_WORKER, "--server-file", file});
  Farm first({"--address-file", file});
  const size_t found = worker.WaitForError("the server is at " + first.address());
  const size_t at_work = worker.WaitForError("at work", found);
  Farm second({"--address-file", file});
  ASSERT_NE(second.address(), first.address());
  const size_t moved = worker.WaitForError("the server is at " + second.address(), at_work);
  EXPECT_NE(worker.WaitForError("at work", moved), std::string::npos);
  worker.Signal(SIGTERM);
  EXPECT_EQ(worker.Wait(), 0);
}

TEST(Programs, RefuseWrongUseWithTwo) {
  EXPECT_EQ(Process({LAMBERT_SERVER, "--no-such-flag"}).Wait(), 2);
  EXPECT_EQ(Process({LAMBERT_WORKER}).Wait(), 2);
  EXPECT_EQ(Process({LAMBERT_WORKER, "--server", "127.0.0.1:1", "--server-file", "f"}).Wait(), 2);
  EXPECT_EQ(Process({LAMBERT_WORKER, "--server", "127.0.0.1:1", "--slots", "0"}).Wait(), 2);
}

TEST(Programs, AServerThatCannotListenSaysSo) {
  Farm first;
  Process second({LAMBERT_SERVER, "--listen", first.address()});
  EXPECT_EQ(second.Wait(), 1);
  EXPECT_NE(second.error().find("error: " + first.address()), std::string::npos);
}

TEST(Programs, AServerThatCannotWriteSaysSo) {
  Process server({LAMBERT_SERVER, "--listen", "127.0.0.1:0", "--data", "/proc/no/such/folder"});
  EXPECT_EQ(server.Wait(), 1);
  EXPECT_NE(server.error().find("error: /proc/no/such/folder"), std::string::npos);
}

// Files may not grow over a limit, which the patch set of the larger scene passes.
TEST(Programs, AFullStoreFailsTheJobAndNothingElse) {
  TemporaryFolder folder;
  Farm farm({"--data", folder.path()}, /*max_file_bytes=*/50'000);
  farm.AddWorker();
  const v1::SolveJob large = farm.Watch(farm.CreateJob(1000, "large", 4).name()).ended;
  ASSERT_EQ(large.state(), v1::SolveJob::STATE_FAILED);
  google::rpc::ErrorInfo info;
  ASSERT_TRUE(large.error().details(0).UnpackTo(&info));
  EXPECT_EQ(info.reason(), "STORE_FULL");
  EXPECT_EQ(farm.Watch(farm.CreateJob(1000, "small", 1).name()).ended.state(),
            v1::SolveJob::STATE_SUCCEEDED);
}

}  // namespace
}  // namespace lambert

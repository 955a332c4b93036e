// Merge shards beside the coordinator: whatever becomes of them, the solution has the bytes of the
// loop that runs in one thread without a network.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "tests/distributed/farm.h"
#include "tests/distributed/same_bytes.h"

namespace lambert {
namespace {

// A server that shards however few patches there are, soon misses who is silent, and its shards.
class ShardedFarm : public Farm {
 public:
  explicit ShardedFarm(int shards) : Farm({"--shard-patches", "1", "--worker-timeout", "1"}) {
    for (int i = 0; i < shards; ++i) AddShard();
  }
  void AddShard() {
    shards_.push_back(
        std::make_unique<Process>(std::vector<std::string>{LAMBERT_MERGER, "--server", address()}));
    shards_.back()->WaitForError("at work as merge shard");
  }
  Process& shard(int i) { return *shards_[i]; }
  // Blocks until the server says that it has lost a shard, after what it said before `from`.
  size_t WaitForLoss(size_t from = 0) { return server().WaitForError("is lost", from); }

 private:
  std::vector<std::unique_ptr<Process>> shards_;
};

class SameBytesSharded : public testing::TestWithParam<int> {};

TEST_P(SameBytesSharded, WithAWorkerKilled) {
  ShardedFarm farm(GetParam());
  for (int i = 0; i < 3; ++i) farm.AddWorker(2);
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.worker(0).Signal(SIGKILL);
  ExpectSameBytes(farm.Watch(job.name()));
}

INSTANTIATE_TEST_SUITE_P(Shards, SameBytesSharded, testing::Values(1, 2, 3));

// What comes to rest and what is seen is cut by patches too, and gray light is.
class SameBytesShardedOfMethod : public testing::TestWithParam<Method> {};

TEST_P(SameBytesShardedOfMethod, WithTwoWorkers) {
  ShardedFarm farm(3);
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares, MethodName(GetParam()));
  ExpectSameBytes(farm.Watch(job.name()), SolveSerially(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Methods, SameBytesShardedOfMethod,
                         testing::Values(Method::kPhsAlpha, Method::kPhsHier, Method::kExact,
                                         Method::kWalk),
                         [](const auto& info) {
                           std::string name = MethodName(info.param);
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

TEST(SameBytesShardedInTrouble, WithAShardKilledInTheMiddle) {
  ShardedFarm farm(2);
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.shard(0).Signal(SIGKILL);
  ExpectSameBytes(farm.Watch(job.name()));
  EXPECT_NE(farm.WaitForLoss(), std::string::npos);
}

TEST(SameBytesShardedInTrouble, WithAShardFrozenAndAllShardsKilledOneAfterTheOther) {
  ShardedFarm farm(3);
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.shard(0).Signal(SIGSTOP);
  const size_t frozen = farm.WaitForLoss();
  farm.shard(1).Signal(SIGKILL);
  const size_t killed = farm.WaitForLoss(frozen);
  farm.shard(2).Signal(SIGKILL);
  ExpectSameBytes(farm.Watch(job.name()));
  EXPECT_NE(farm.WaitForLoss(killed), std::string::npos);
}

TEST(SameBytesShardedInTrouble, WithAShardThatLeavesAndOneThatComesLate) {
  ShardedFarm farm(1);
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name());
  farm.shard(0).Signal(SIGTERM);
  EXPECT_EQ(farm.shard(0).Wait(), 0);
  farm.AddShard();
  ExpectSameBytes(farm.Watch(job.name()));
}

TEST(SameBytesShardedInTrouble, WithTheServerKilledAndStartedAgain) {
  TemporaryFolder folder;
  Farm farm({"--data", folder.path(), "--shard-patches", "1"});
  Process shard({LAMBERT_MERGER, "--server", farm.address()});
  shard.WaitForError("at work as merge shard");
  for (int i = 0; i < 2; ++i) farm.AddWorker();
  const v1::SolveJob job = farm.CreateJob(kRays, "", kSquares);
  farm.WaitUntilUnderWay(job.name(), 3);
  farm.KillAndRestartServer();
  ExpectSameBytes(farm.Watch(job.name()));
}

TEST(Merger, IsRefusedWithoutTheRoleAndWithWrongUse) {
  TemporaryFolder folder;
  const std::string tokens = folder.path() + "/tokens";
  const auto token = [&](const std::string& role) {
    Process made({LAMBERT_SERVER, "--tokens", tokens, "--new-token", role, "--role", role});
    EXPECT_EQ(made.Wait(), 0) << made.error();
    std::ofstream(folder.path() + "/" + role) << made.output();
    return folder.path() + "/" + role;
  };
  const std::string worker = token("worker"), merger = token("merger");
  Farm farm({"--tokens", tokens});
  Process wrong({LAMBERT_MERGER, "--server", farm.address(), "--token-file", worker});
  EXPECT_EQ(wrong.Wait(), 1);
  EXPECT_NE(wrong.error().find("a worker may not call this"), std::string::npos) << wrong.error();
  Process right({LAMBERT_MERGER, "--server", farm.address(), "--token-file", merger, "--tokens",
                 tokens, "--log-format", "json", "--advertise", "localhost"});
  right.WaitForError("at work as merge shard");
  farm.server().WaitForError("at localhost:");
  right.Signal(SIGTERM);
  EXPECT_EQ(right.Wait(), 0);
  EXPECT_EQ(Process({LAMBERT_MERGER}).Wait(), 2);
  Process open({LAMBERT_MERGER, "--server", farm.address(), "--listen", "0.0.0.0:0"});
  EXPECT_EQ(open.Wait(), 1);
  EXPECT_NE(open.error().find("anybody who reaches"), std::string::npos) << open.error();
}

}  // namespace
}  // namespace lambert

// Two servers on one PostgreSQL database: one works, the other stands by and takes over.
#include <gtest/gtest.h>

#include "tests/distributed/farm.h"
#include "tests/distributed/serial_solution.h"
#include "tests/support/temporary_postgres.h"

namespace lambert {
namespace {

constexpr int64_t kRays = 3'000'000;  // about a second of one core

class Standby : public testing::Test {
 protected:
  void SetUp() override {
    std::string why;
    if (!TemporaryPostgres::IsPossible(why)) GTEST_SKIP() << why;
    postgres_ = std::make_unique<TemporaryPostgres>();
    farm_ = std::make_unique<Farm>(Stores());
    for (int i = 0; i < 2; ++i) farm_->AddWorker();
  }
  std::vector<std::string> Stores() const {
    return {"--data", folder_.path(), "--database", postgres_->url()};
  }
  std::unique_ptr<Process> StandBy(const std::string& listen) {
    std::vector<std::string> command = {LAMBERT_SERVER, "--listen", listen};
    for (const std::string& argument : Stores()) command.push_back(argument);
    auto server = std::make_unique<Process>(command);
    EXPECT_NE(server->WaitForError("standing by"), std::string::npos) << server->error();
    return server;
  }
  static void ExpectSameBytes(const ServiceCalls::Watched& watched) {
    SolveOptions options;
    options.shoot.method = Method::kAuto;
    options.max_rays = kRays;
    EXPECT_EQ(watched.ended.state(), v1::SolveJob::STATE_SUCCEEDED)
        << watched.ended.error().message();
    EXPECT_TRUE(watched.payload == SolveSerially(options));
  }

  TemporaryFolder folder_;
  std::unique_ptr<TemporaryPostgres> postgres_;
  std::unique_ptr<Farm> farm_;
};

TEST_F(Standby, TakesOverAtTheAddressOfAServerThatWasKilled) {
  const v1::SolveJob job = farm_->CreateJob(kRays, "", kSquares);
  auto standby = StandBy(farm_->address());
  farm_->WaitUntilUnderWay(job.name());
  farm_->server().Signal(SIGKILL);
  ASSERT_NE(standby->WaitForError("listening on " + farm_->address()), std::string::npos)
      << standby->error();
  ExpectSameBytes(farm_->Watch(job.name()));
}

TEST_F(Standby, TakesOverFromAServerThatIsFrozenWhichEndsWhenItThaws) {
  const v1::SolveJob job = farm_->CreateJob(kRays, "", kSquares);
  auto standby = StandBy("127.0.0.1:0");
  farm_->WaitUntilUnderWay(job.name());
  farm_->server().Signal(SIGSTOP);
  const size_t begin = standby->WaitForError("listening on ");
  ASSERT_NE(begin, std::string::npos) << standby->error();
  const size_t end = standby->WaitForError("\n", begin);
  const std::string address = standby->error().substr(begin, end - 1 - begin);
  farm_->server().Signal(SIGCONT);
  EXPECT_EQ(farm_->server().Wait(), 1);
  EXPECT_NE(farm_->server().error().find("another server has taken over"), std::string::npos)
      << farm_->server().error();
  Process worker({LAMBERT_WORKER, "--server", address});
  ServiceCalls calls;
  calls.Connect(grpc::CreateChannel(address, grpc::InsecureChannelCredentials()));
  ExpectSameBytes(calls.Watch(job.name()));
}

TEST_F(Standby, TakesOverAtOnceFromAServerThatIsStoppedAndLeavesWithZeroWhileItWaits) {
  auto standby = StandBy(farm_->address()), third = StandBy("127.0.0.1:0");
  third->Signal(SIGTERM);
  EXPECT_EQ(third->Wait(), 0);
  const v1::SolveJob job = farm_->CreateJob(kRays, "", kSquares);
  farm_->server().Signal(SIGTERM);
  EXPECT_EQ(farm_->server().Wait(), 0);
  ASSERT_NE(standby->WaitForError("listening on"), std::string::npos) << standby->error();
  ExpectSameBytes(farm_->Watch(job.name()));
}

TEST_F(Standby, OutlastsARestartOfTheDatabaseInTheMiddle) {
  const v1::SolveJob job = farm_->CreateJob(kRays, "", kSquares);
  farm_->WaitUntilUnderWay(job.name());
  postgres_->Restart();
  ExpectSameBytes(farm_->Watch(job.name()));
}

}  // namespace
}  // namespace lambert

#include "client/caller.h"

#include <thread>

#include "gtest/gtest.h"
#include "radiosity/core/error.h"
#include "tests/client/fake_server.h"

namespace lambert::client {
namespace {

constexpr std::chrono::duration<double> kDeadline{5};

grpc::Status Away() { return {grpc::StatusCode::UNAVAILABLE, "connection refused"}; }

TEST(Caller, ACallThatSucceedsIsMadeOnce) {
  NotedCaller noted;
  int attempts = 0;
  EXPECT_TRUE(noted.caller
                  .Call("job", kDeadline,
                        [&](grpc::ClientContext&) {
                          ++attempts;
                          return grpc::Status::OK;
                        })
                  .ok());
  EXPECT_EQ(attempts, 1);
  EXPECT_TRUE(noted.notices.empty());
}

TEST(Caller, AServerThatIsAwayIsTriedAgainAndTheUserIsTold) {
  NotedCaller noted;
  int attempts = 0;
  EXPECT_TRUE(
      noted.caller
          .Call("job", kDeadline,
                [&](grpc::ClientContext&) { return ++attempts < 3 ? Away() : grpc::Status::OK; })
          .ok());
  EXPECT_EQ(attempts, 3);
  ASSERT_EQ(noted.notices.size(), 2u);
  EXPECT_EQ(noted.notices[0], "lost test (connection refused); trying again for 60 s");
  EXPECT_EQ(noted.notices[1], "back at test");
}

TEST(Caller, WithoutPatienceTheFirstFailureIsTheLast) {
  NotedCaller noted(0);
  const absl::Status status = noted.caller.Call(
      "job", kDeadline, [](grpc::ClientContext&) { return Away(); }, "do this");
  EXPECT_EQ(status.code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(ReasonOf(status), "SERVER_UNREACHABLE");
  EXPECT_EQ(status.message(), "test: the server is away (connection refused); do this");
}

TEST(Caller, OtherErrorsAreNotRepeated) {
  NotedCaller noted;
  int attempts = 0;
  const absl::Status status = noted.caller.Call("solveJobs/a", kDeadline, [&](auto&) {
    ++attempts;
    return grpc::Status(grpc::StatusCode::NOT_FOUND, "no such job");
  });
  EXPECT_EQ(attempts, 1);
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
}

TEST(Caller, AbortEndsAWaitAndAllLaterCalls) {
  NotedCaller noted;
  std::thread other;
  const absl::Status status = noted.caller.Call("job", kDeadline, [&](auto&) {
    if (!other.joinable()) other = std::thread([&] { noted.caller.Abort(); });
    return Away();
  });
  other.join();
  EXPECT_EQ(ReasonOf(status), "INTERRUPTED");
  int attempts = 0;
  EXPECT_FALSE(noted.caller
                   .Call("job", kDeadline,
                         [&](auto&) {
                           ++attempts;
                           return grpc::Status::OK;
                         })
                   .ok());
  EXPECT_EQ(attempts, 0);
}

}  // namespace
}  // namespace lambert::client

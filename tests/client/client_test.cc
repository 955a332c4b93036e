#include "client/client.h"

#include <deque>

#include "gtest/gtest.h"
#include "lambert/v1/solve_job_service.grpc.pb.h"
#include "tests/client/fake_server.h"

namespace lambert::client {
namespace {

// Answers one call after the other as it was told, and the last way from then on.
class FakeJobs : public v1::SolveJobService::Service {
 public:
  grpc::Status DeleteSolveJob(grpc::ServerContext*, const v1::DeleteSolveJobRequest*,
                              google::protobuf::Empty*) override {
    const grpc::StatusCode code = answers.front();
    if (answers.size() > 1) answers.pop_front();
    return {code, "as told"};
  }
  std::deque<grpc::StatusCode> answers;
};

absl::StatusCode Delete(std::deque<grpc::StatusCode> answers) {
  FakeJobs jobs;
  jobs.answers = std::move(answers);
  FakeServer server(&jobs);
  Client client(server.channel(), {});
  return client.DeleteJob("solveJobs/a").code();
}

TEST(ClientDeleteJob, AJobThatIsGoneAfterALostAnswerIsDeleted) {
  using grpc::StatusCode;
  EXPECT_EQ(Delete({StatusCode::OK}), absl::StatusCode::kOk);
  EXPECT_EQ(Delete({StatusCode::NOT_FOUND}), absl::StatusCode::kNotFound);
  EXPECT_EQ(Delete({StatusCode::UNAVAILABLE, StatusCode::NOT_FOUND}), absl::StatusCode::kOk);
  EXPECT_EQ(Delete({StatusCode::UNAVAILABLE, StatusCode::INVALID_ARGUMENT}),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace lambert::client

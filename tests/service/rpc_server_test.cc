#include "server/rpc/rpc_server.h"

#include <grpcpp/impl/codegen/client_unary_call.h>
#include <grpcpp/impl/codegen/rpc_method.h>

#include "grpc/health/v1/health.pb.h"
#include "radiosity/core/error.h"
#include "tests/service/service_fixture.h"

namespace lambert {
namespace {

using RpcServerTest = ServiceFixture;

TEST_F(RpcServerTest, AnswersHealthChecks) {
  const grpc::internal::RpcMethod check("/grpc.health.v1.Health/Check",
                                        grpc::internal::RpcMethod::NORMAL_RPC);
  grpc::ClientContext context;
  grpc::health::v1::HealthCheckRequest request;
  grpc::health::v1::HealthCheckResponse response;
  const grpc::Status status =
      grpc::internal::BlockingUnaryCall<grpc::health::v1::HealthCheckRequest,
                                        grpc::health::v1::HealthCheckResponse,
                                        grpc::protobuf::MessageLite, grpc::protobuf::MessageLite>(
          channel().get(), check, &context, request, &response);
  EXPECT_TRUE(status.ok()) << status.error_message();
  EXPECT_EQ(response.status(), grpc::health::v1::HealthCheckResponse::SERVING);
}

TEST_F(RpcServerTest, TwoServersDoNotShareAPort) {
  auto first = *server::RpcServer::Start(coordinator_.get(), "127.0.0.1:0");
  const absl::Status second =
      server::RpcServer::Start(coordinator_.get(), first->address()).status();
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(ReasonOf(second), "ADDRESS_IN_USE");
}

}  // namespace
}  // namespace lambert

#include "server/rpc/rpc_server.h"

#include <grpcpp/ext/proto_server_reflection_plugin.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/health_check_service_interface.h>

#include <chrono>
#include <utility>
#include <vector>

#include "grpc/health/v1/health.pb.h"
#include "radiosity/core/error.h"
#include "server/coordinator.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

// Calls that do not end by themselves at shutdown are cut off after that.
constexpr auto kGrace = std::chrono::milliseconds(500);
constexpr int kKeepaliveMs = 20'000;
constexpr int kMinClientPingMs = 1'000;
constexpr int kHandshakeMs = 10'000;      // connections that have not begun to speak by then end
constexpr int kMaxGrantBytes = 64 << 20;  // what a worker takes in one message

void SetKeepalive(grpc::ServerBuilder& builder) {
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIME_MS, kKeepaliveMs);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_TIMEOUT_MS, kKeepaliveMs);
  builder.AddChannelArgument(GRPC_ARG_KEEPALIVE_PERMIT_WITHOUT_CALLS, 1);
  builder.AddChannelArgument(GRPC_ARG_SERVER_HANDSHAKE_TIMEOUT_MS, kHandshakeMs);
  // Clients may ping often, to see a lost server soon.
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MIN_RECV_PING_INTERVAL_WITHOUT_DATA_MS,
                             kMinClientPingMs);
  builder.AddChannelArgument(GRPC_ARG_HTTP2_MAX_PING_STRIKES, 0);
  // Two servers on one port would each get half of the calls.
  builder.AddChannelArgument(GRPC_ARG_ALLOW_REUSEPORT, 0);
}

class RpcServerImpl : public RpcServer {
 public:
  RpcServerImpl(const MakeServices& make, std::function<void()> stop,
                std::unique_ptr<const Doors> doors)
      : stop_(std::move(stop)), doors_(std::move(doors)), services_(make(doors_.get())) {}
  ~RpcServerImpl() override {
    stop_();
    if (server_ == nullptr) return;
    server_->GetHealthCheckService()->SetServingStatus(false);
    server_->Shutdown(std::chrono::system_clock::now() + kGrace);
    server_->Wait();
  }

  absl::Status Listen(const std::string& listen) {
    grpc::ServerBuilder builder;
    SetKeepalive(builder);
    int port = 0;
    if (!listen.empty()) {
      builder.AddListeningPort(listen, doors_->credentials(), &port);
    }
    for (auto& service : services_) builder.RegisterService(service.get());
    server_ = builder.BuildAndStart();
    if (server_ == nullptr || (!listen.empty() && port == 0)) {
      return MakeError(absl::StatusCode::kUnavailable,
                       {"ADDRESS_IN_USE", listen, "the server cannot listen there",
                        "choose another --listen HOST:PORT"});
    }
    address_ = listen.substr(0, listen.rfind(':') + 1) + std::to_string(port);
    return absl::OkStatus();
  }

  std::string address() const override { return address_; }
  std::shared_ptr<grpc::Channel> InProcessChannel() override {
    grpc::ChannelArguments arguments;
    arguments.SetMaxReceiveMessageSize(kMaxGrantBytes);
    return server_->InProcessChannel(arguments);
  }

 private:
  const std::function<void()> stop_;
  const std::unique_ptr<const Doors> doors_;
  std::vector<std::unique_ptr<grpc::Service>> services_;
  std::unique_ptr<grpc::Server> server_;
  std::string address_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<RpcServer>> RpcServer::Start(Coordinator* coordinator,
                                                            const std::string& listen,
                                                            const DoorOptions& doors) {
  const auto make = [coordinator](const Doors* opened) {
    std::vector<std::unique_ptr<grpc::Service>> services;
    for (auto make_one :
         {MakeBlobService, MakeSceneService, MakeSolveJobService, MakeGatherService,
          MakeSnapshotService, MakeFarmService, MakeWorkerService, MakeMergeService}) {
      services.push_back(make_one(coordinator, opened));
    }
    return services;
  };
  return Start(
      make, [coordinator] { coordinator->Shutdown(); }, listen, doors);
}

absl::StatusOr<std::unique_ptr<RpcServer>> RpcServer::Start(const MakeServices& make,
                                                            std::function<void()> stop,
                                                            const std::string& listen,
                                                            const DoorOptions& door_options) {
  absl::StatusOr<std::unique_ptr<Doors>> doors = Doors::Open(door_options, listen);
  if (!doors.ok()) return doors.status();
  grpc::EnableDefaultHealthCheckService(true);
  grpc::reflection::InitProtoReflectionServerBuilderPlugin();
  // Links the descriptor of the health service, which reflection shows.
  grpc::health::v1::HealthCheckRequest::descriptor();
  auto server = std::make_unique<RpcServerImpl>(make, std::move(stop), *std::move(doors));
  if (absl::Status status = server->Listen(listen); !status.ok()) return status;
  return server;
}

}  // namespace lambert::server

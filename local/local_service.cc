#include "local/local_service.h"

#include <grpcpp/grpcpp.h>

#include <string>
#include <utility>
#include <vector>

#include "server/coordinator.h"
#include "server/rpc/rpc_server.h"
#include "worker/worker.h"

namespace lambert {
namespace {

class LocalServiceImpl : public LocalService {
 public:
  LocalServiceImpl(std::unique_ptr<server::Coordinator> coordinator,
                   std::unique_ptr<server::RpcServer> rpc, const LocalServiceOptions& options)
      : coordinator_(std::move(coordinator)),
        rpc_(std::move(rpc)),
        channel_(rpc_->InProcessChannel()) {
    for (int i = 0; i < options.workers; ++i) {
      worker::WorkerOptions worker;
      worker.worker_id = "local-" + std::to_string(i + 1);
      worker.slots = options.threads_per_worker;
      workers_.push_back(std::make_unique<worker::Worker>(rpc_->InProcessChannel(), worker));
    }
  }
  ~LocalServiceImpl() override {
    coordinator_->Shutdown();
    workers_.clear();
    channel_.reset();
  }

  std::shared_ptr<grpc::Channel> channel() override { return channel_; }

 private:
  // Destroyed from the last to the first: workers, calls, then what calls use.
  const std::unique_ptr<server::Coordinator> coordinator_;
  const std::unique_ptr<server::RpcServer> rpc_;
  std::shared_ptr<grpc::Channel> channel_;
  std::vector<std::unique_ptr<worker::Worker>> workers_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<LocalService>> LocalService::Start(
    const LocalServiceOptions& options) {
  server::CoordinatorOptions limited;
  limited.scene = options.limits;
  limited.max_patches = options.max_patches;
  absl::StatusOr<std::unique_ptr<server::Coordinator>> coordinator =
      server::Coordinator::Start(limited);
  if (!coordinator.ok()) return coordinator.status();
  absl::StatusOr<std::unique_ptr<server::RpcServer>> rpc =
      server::RpcServer::Start(coordinator->get(), "");
  if (!rpc.ok()) return rpc.status();
  return std::make_unique<LocalServiceImpl>(*std::move(coordinator), *std::move(rpc), options);
}

}  // namespace lambert

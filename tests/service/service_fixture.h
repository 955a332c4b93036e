// A whole coordinator behind in-process channels, with workers in this process.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "server/coordinator.h"
#include "server/rpc/rpc_server.h"
#include "tests/service/service_calls.h"
#include "worker/worker.h"

namespace lambert {

class ServiceFixture : public testing::Test, public ServiceCalls {
 protected:
  ServiceFixture() { Start({}); }
  ~ServiceFixture() override { Stop(); }

  void Start(const server::CoordinatorOptions& options) {
    Stop();
    Serve(*server::Coordinator::Start(options));
  }
  void Serve(std::unique_ptr<server::Coordinator> coordinator) {
    coordinator_ = std::move(coordinator);
    rpc_ = *server::RpcServer::Start(coordinator_.get(), "");
    Connect(rpc_->InProcessChannel());
  }
  void Stop() {
    workers_.clear();
    Connect(nullptr);
    rpc_.reset();
    coordinator_.reset();
  }
  void AddWorker(worker::ShooterFactory make_shooter = Shooter::Create, int slots = 1) {
    worker::WorkerOptions options;
    options.worker_id = "worker-" + std::to_string(workers_.size());
    options.slots = slots;
    options.make_shooter = std::move(make_shooter);
    workers_.push_back(std::make_unique<worker::Worker>(rpc_->InProcessChannel(), options));
  }

  std::unique_ptr<server::Coordinator> coordinator_;
  std::unique_ptr<server::RpcServer> rpc_;
  std::vector<std::unique_ptr<worker::Worker>> workers_;
};

}  // namespace lambert

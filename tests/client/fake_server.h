// A gRPC server in the test's process that holds one fake service.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "client/caller.h"
#include "grpcpp/channel.h"
#include "grpcpp/server.h"
#include "grpcpp/server_builder.h"

namespace lambert::client {

class FakeServer {
 public:
  explicit FakeServer(grpc::Service* service) {
    grpc::ServerBuilder builder;
    builder.RegisterService(service);
    server_ = builder.BuildAndStart();
  }
  ~FakeServer() { server_->Shutdown(); }
  std::shared_ptr<grpc::Channel> channel() {
    return server_->InProcessChannel(grpc::ChannelArguments());
  }

 private:
  std::unique_ptr<grpc::Server> server_;
};

// A Caller that remembers what it told.
struct NotedCaller {
  explicit NotedCaller(double patience_s = 60)
      : caller("test", std::chrono::duration<double>(patience_s),
               [this](const std::string& line) { notices.push_back(line); }) {}
  std::vector<std::string> notices;
  Caller caller;
};

}  // namespace lambert::client

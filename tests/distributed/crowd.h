// Many workers that shoot no rays, and many watchers that never read, at one server.
#pragma once

#include <grpcpp/grpcpp.h>

#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "tests/distributed/farm.h"
#include "tests/support/stub_shooter.h"
#include "worker/worker.h"

namespace lambert {

// A connection of its own: those of one program are shared otherwise.
inline std::shared_ptr<grpc::Channel> OwnConnection(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  arguments.SetMaxReceiveMessageSize(64 << 20);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(), arguments);
}

class StubWorkers {
 public:
  StubWorkers(const std::string& address, int count) {
    for (int i = 0; i < count; ++i) {
      worker::WorkerOptions options;
      options.worker_id = "stub-" + std::to_string(i);
      options.make_shooter = MakeStubShooter;
      workers_.push_back(std::make_unique<worker::Worker>(OwnConnection(address), options));
    }
  }

 private:
  std::vector<std::unique_ptr<worker::Worker>> workers_;
};

// Watchers of a job who ask for everything and read nothing.
class IdleWatchers {
 public:
  IdleWatchers(const std::string& address, const std::string& job, int count) {
    v1::WatchSnapshotsRequest request;
    request.set_parent(job);
    request.set_view(v1::SNAPSHOT_VIEW_FULL);
    for (int i = 0; i < count; ++i) {
      auto& watcher = watchers_.emplace_back(std::make_unique<Watcher>());
      watcher->stub = v1::SnapshotService::NewStub(OwnConnection(address));
      watcher->stream = watcher->stub->WatchSnapshots(&watcher->context, request);
    }
  }
  ~IdleWatchers() {
    for (auto& watcher : watchers_) watcher->context.TryCancel();
  }

 private:
  struct Watcher {
    std::unique_ptr<v1::SnapshotService::Stub> stub;
    grpc::ClientContext context;
    std::unique_ptr<grpc::ClientReader<v1::WatchSnapshotsResponse>> stream;
  };
  std::vector<std::unique_ptr<Watcher>> watchers_;
};

// A number of /proc/PID/status [KiB]: VmRSS is resident memory, VmHWM the most that it was.
inline int64_t StatusKiB(pid_t process, const std::string& name) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    int64_t value = 0;
    if (word == name + ":" && status >> value) return value;
  }
  return -1;
}

}  // namespace lambert

// A worker: takes units of work from a coordinator, runs them, sends the results back.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "net/channel.h"
#include "radiosity/core/log.h"
#include "worker/shooter_cache.h"
#include "worker/worker_counters.h"

namespace grpc {
class Channel;
}

namespace lambert::worker {

struct WorkerOptions {
  std::string worker_id;     // unique among the workers of a server, 1 to 128 characters
  int slots = 1;             // units that run at once, each on its own thread, 1 to 4096
  std::string unit_version;  // "": that of this program
  ShooterFactory make_shooter = Shooter::Create;
  // How merge shards are reached, which the server names.
  std::function<absl::StatusOr<std::shared_ptr<grpc::Channel>>(const std::string& address)>
      connect = [](const std::string& address) { return ConnectToServer(address); };
  Log log = [](const LogLine&) {};
  // Is kept up to date; workers that follow one another may share it.
  std::shared_ptr<WorkerCounters> counters = std::make_shared<WorkerCounters>();
  // The server will never take this worker (another unit version); any thread.
  std::function<void(const absl::Status&)> on_refused = [](const absl::Status&) {};
};

// Runs until it is destroyed. A server that goes away is tried again, for ever; work that was under
// way meanwhile is finished and offered.
class Worker {
 public:
  Worker(std::shared_ptr<grpc::Channel> channel, const WorkerOptions& options);
  // Finishes the units that run and sends their results, unless the server is not there; hands back
  // those that wait.
  ~Worker();

 private:
  class Impl;
  const std::unique_ptr<Impl> impl_;
};

}  // namespace lambert::worker

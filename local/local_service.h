// The whole service in one process: a coordinator and its workers, without a socket or a disk.
#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"

namespace grpc {
class Channel;
}

namespace lambert {

struct LocalServiceOptions {
  int workers = 1;             // > 0
  int threads_per_worker = 1;  // > 0: units that one worker runs at once
  SceneLimits limits = {};
  int64_t max_patches = PatchOptions().max_patches;  // of a job
};

// The same server and worker code that `lambert-server` and `lambert-worker` run, joined by gRPC's
// in-process channels; results are equal to theirs bit for bit. Everything is kept in memory and is
// gone with the object.
class LocalService {
 public:
  static absl::StatusOr<std::unique_ptr<LocalService>> Start(const LocalServiceOptions& options);
  // Stops jobs, workers and the coordinator; waits for units that are being run. Requires: no call
  // is under way on `channel()`.
  virtual ~LocalService() = default;

  // For a client; any thread.
  virtual std::shared_ptr<grpc::Channel> channel() = 0;
};

}  // namespace lambert

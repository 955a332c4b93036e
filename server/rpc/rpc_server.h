// A coordinator's gRPC server: all services, health and reflection.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/doors/doors.h"

namespace grpc {
class Channel;
}

namespace lambert::server {

class Coordinator;

// Thread safe.
class RpcServer {
 public:
  // `listen`: HOST:PORT, port 0 for any; "" for in-process channels only. UNAVAILABLE
  // (ADDRESS_IN_USE) where it cannot be had; errors of Doors::Open. The coordinator has to outlive
  // the server. Health and reflection answer everybody: they tell nothing of anybody's.
  static absl::StatusOr<std::unique_ptr<RpcServer>> Start(Coordinator* coordinator,
                                                          const std::string& listen,
                                                          const DoorOptions& doors = {});
  // Shuts the coordinator down, ends all calls, and waits for them.
  virtual ~RpcServer() = default;

  // HOST:PORT with the real port.
  virtual std::string address() const = 0;
  virtual std::shared_ptr<grpc::Channel> InProcessChannel() = 0;
};

}  // namespace lambert::server

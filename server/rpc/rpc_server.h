// The gRPC server of a coordinator, or of a merge shard: its services, health and reflection.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "server/doors/doors.h"

namespace grpc {
class Channel;
class Service;
}  // namespace grpc

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
  // The same for other services; `stop` ends the calls that they hold.
  using MakeServices =
      std::function<std::vector<std::unique_ptr<grpc::Service>>(const Doors* doors)>;
  static absl::StatusOr<std::unique_ptr<RpcServer>> Start(const MakeServices& make,
                                                          std::function<void()> stop,
                                                          const std::string& listen,
                                                          const DoorOptions& doors);
  // Shuts the coordinator down, or stops, ends all calls, and waits for them.
  virtual ~RpcServer() = default;

  // HOST:PORT with the real port.
  virtual std::string address() const = 0;
  virtual std::shared_ptr<grpc::Channel> InProcessChannel() = 0;
};

}  // namespace lambert::server

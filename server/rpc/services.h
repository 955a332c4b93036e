// The gRPC services of a coordinator, each in its own file. A handler asks the doors who calls,
// decodes, makes one call, encodes.
#pragma once

#include <grpcpp/impl/service_type.h>

#include <memory>

namespace lambert::server {

class Coordinator;
class Doors;

// Coordinator and doors have to outlive the service; every service is thread safe.
std::unique_ptr<grpc::Service> MakeBlobService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeSceneService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeSolveJobService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeSnapshotService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeGatherService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeFarmService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeWorkerService(Coordinator* coordinator, const Doors* doors);

}  // namespace lambert::server

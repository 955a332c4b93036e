// The gRPC services of a coordinator, each in its own file. A handler decodes, makes one call,
// encodes.
#pragma once

#include <grpcpp/impl/service_type.h>

#include <memory>

namespace lambert::server {

class Coordinator;

// The coordinator has to outlive the service; every service is thread safe.
std::unique_ptr<grpc::Service> MakeBlobService(Coordinator* coordinator);
std::unique_ptr<grpc::Service> MakeSceneService(Coordinator* coordinator);
std::unique_ptr<grpc::Service> MakeSolveJobService(Coordinator* coordinator);
std::unique_ptr<grpc::Service> MakeSnapshotService(Coordinator* coordinator);
std::unique_ptr<grpc::Service> MakeFarmService(Coordinator* coordinator);
std::unique_ptr<grpc::Service> MakeWorkerService(Coordinator* coordinator);

}  // namespace lambert::server

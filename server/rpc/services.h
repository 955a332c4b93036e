// The gRPC services of a coordinator, and of a merge shard, each in its own file. A handler asks
// the doors who calls, decodes, makes one call, encodes.
#pragma once

#include <grpcpp/impl/service_type.h>

#include <memory>
#include <string>

namespace lambert::server {

class Coordinator;
class Doors;
class MergeShard;

// Coordinator and doors have to outlive the service; every service is thread safe.
std::unique_ptr<grpc::Service> MakeBlobService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeSceneService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeSolveJobService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeSnapshotService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeGatherService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeFarmService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeWorkerService(Coordinator* coordinator, const Doors* doors);
std::unique_ptr<grpc::Service> MakeMergeService(Coordinator* coordinator, const Doors* doors);

// The service of a merge shard of that name, likewise.
std::unique_ptr<grpc::Service> MakePartService(MergeShard* shard, const std::string& name,
                                               const Doors* doors);

}  // namespace lambert::server

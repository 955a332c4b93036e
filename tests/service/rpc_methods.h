// The methods that a coordinator answers, by the descriptors of the protocol.
#pragma once

#include <string>
#include <vector>

#include "google/protobuf/descriptor.h"
#include "lambert/v1/blob_service.pb.h"
#include "lambert/v1/farm_service.pb.h"
#include "lambert/v1/gather_service.pb.h"
#include "lambert/v1/scene_service.pb.h"
#include "lambert/v1/snapshot_service.pb.h"
#include "lambert/v1/solve_job_service.pb.h"
#include "lambert/worker/v1/merge_service.pb.h"
#include "lambert/worker/v1/worker_service.pb.h"

namespace lambert {

// In the order of the services' names.
inline std::vector<const google::protobuf::MethodDescriptor*> AllRpcMethods() {
  std::vector<const google::protobuf::MethodDescriptor*> methods;
  for (const google::protobuf::FileDescriptor* file :
       {v1::Digest::descriptor()->file(), v1::ListWorkersRequest::descriptor()->file(),
        v1::Gather::descriptor()->file(), v1::Scene::descriptor()->file(),
        v1::WatchSnapshotsRequest::descriptor()->file(), v1::SolveJob::descriptor()->file(),
        worker::v1::MergeStep::descriptor()->file(), worker::v1::Lease::descriptor()->file()}) {
    for (int i = 0; i < file->service_count(); ++i) {
      if (file->service(i)->name() == "PartService") continue;  // of merge shards
      for (int j = 0; j < file->service(i)->method_count(); ++j) {
        methods.push_back(file->service(i)->method(j));
      }
    }
  }
  return methods;
}

// "/lambert.v1.BlobService/UploadBlob".
inline std::string PathOf(const google::protobuf::MethodDescriptor& method) {
  return "/" + std::string(method.service()->full_name()) + "/" + std::string(method.name());
}

}  // namespace lambert

// The stream of news about one job, over as many connections as it takes.
#pragma once

#include "absl/status/statusor.h"
#include "client/caller.h"
#include "client/client.h"
#include "client/job.h"
#include "lambert/v1/snapshot_service.grpc.pb.h"

namespace lambert::client {

// See Client::Watch.
absl::StatusOr<Job> WatchJob(v1::SnapshotService::StubInterface& stub, Caller& caller,
                             const std::string& job, const WatchOptions& options);

}  // namespace lambert::client

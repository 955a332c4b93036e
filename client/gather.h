// A final gather over a server: points go up, values come down.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "client/blobs.h"
#include "client/caller.h"
#include "lambert/v1/gather_service.grpc.pb.h"
#include "radiosity/gather/gather_points.h"

namespace lambert::client {

// Client::Gather, with the calls that it makes.
absl::StatusOr<Gathered> GatherOver(v1::GatherService::StubInterface& stub, Caller& caller,
                                    Blobs& blobs, const std::string& job,
                                    const GatherPoints& points, const GatherOptions& options,
                                    const std::function<void(size_t, size_t)>& on_progress);

}  // namespace lambert::client

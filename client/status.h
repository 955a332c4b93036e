// Statuses of calls and jobs -> absl::Status with the ErrorDetail that users read.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "google/rpc/status.pb.h"
#include "grpcpp/support/status.h"

namespace lambert::client {

// Takes where, message and hint from ErrorInfo's metadata where the server gives them; `where`
// names what the call was about otherwise. Codes are kept.
absl::Status FromGrpc(const grpc::Status& status, const std::string& where);
absl::Status FromRpcStatus(const google::rpc::Status& status, const std::string& where);

}  // namespace lambert::client

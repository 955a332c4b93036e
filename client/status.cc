#include "client/status.h"

#include "google/rpc/error_details.pb.h"
#include "radiosity/core/error.h"

namespace lambert::client {
namespace {

constexpr char kHint[] = "see the server's log";

std::string Value(const google::rpc::ErrorInfo& info, const std::string& key,
                  const std::string& otherwise) {
  const auto found = info.metadata().find(key);
  return found == info.metadata().end() || found->second.empty() ? otherwise : found->second;
}

}  // namespace

absl::Status FromRpcStatus(const google::rpc::Status& status, const std::string& where) {
  if (status.code() == 0) return absl::OkStatus();
  const auto code = static_cast<absl::StatusCode>(status.code());
  ErrorDetail detail{absl::StatusCodeToString(code), where, status.message(), kHint};
  for (const google::protobuf::Any& any : status.details()) {
    google::rpc::ErrorInfo info;
    if (!any.UnpackTo(&info)) continue;
    detail = {info.reason(), Value(info, "where", where), Value(info, "message", status.message()),
              Value(info, "hint", kHint)};
  }
  return MakeError(code, detail);
}

absl::Status FromGrpc(const grpc::Status& status, const std::string& where) {
  google::rpc::Status rpc;
  // Not every status has details: those that gRPC itself makes have none.
  if (!rpc.ParseFromString(status.error_details())) rpc.Clear();
  rpc.set_code(status.error_code());
  rpc.set_message(status.error_message());
  return FromRpcStatus(rpc, where);
}

}  // namespace lambert::client

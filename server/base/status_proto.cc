#include "server/base/status_proto.h"

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "google/rpc/error_details.pb.h"
#include "radiosity/core/error.h"

namespace lambert::server {
namespace {

constexpr char kDomain[] = "lambert";
constexpr char kMetadataPrefix[] = "lambert/metadata/";
constexpr char kMissingBlobs[] = "lambert/missing-blobs";

// All of a status has to fit into the 8 KiB that gRPC takes of metadata.
constexpr size_t kMaxTextBytes = 800;
constexpr int kMaxMissingBlobs = 16;
constexpr int kRetrySeconds = 1;  // about what a restart takes

// At most kMaxTextBytes, whole UTF-8 characters.
std::string Cut(const std::string& text) {
  if (text.size() <= kMaxTextBytes) return text;
  size_t end = kMaxTextBytes;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + "...";
}

std::string DefaultReason(absl::StatusCode code) {
  return code == absl::StatusCode::kInternal ? "INTERNAL" : absl::StatusCodeToString(code);
}

google::rpc::ErrorInfo MakeErrorInfo(const absl::Status& status) {
  google::rpc::ErrorInfo info;
  info.set_domain(kDomain);
  info.set_reason(DefaultReason(status.code()));
  if (auto detail = GetErrorDetail(status)) {
    info.set_reason(detail->reason);
    (*info.mutable_metadata())["where"] = Cut(detail->where);
    (*info.mutable_metadata())["message"] = Cut(detail->message);
    (*info.mutable_metadata())["hint"] = Cut(detail->hint);
  }
  status.ForEachPayload([&](absl::string_view type, const absl::Cord& payload) {
    if (!absl::StartsWith(type, kMetadataPrefix)) return;
    type.remove_prefix(sizeof(kMetadataPrefix) - 1);
    (*info.mutable_metadata())[std::string(type)] = std::string(payload);
  });
  return info;
}

}  // namespace

google::rpc::Status ToStatusProto(const absl::Status& status) {
  google::rpc::Status proto;
  proto.set_code(static_cast<int>(status.code()));
  if (status.ok()) return proto;
  proto.set_message(Cut(std::string(status.message())));
  const google::rpc::ErrorInfo info = MakeErrorInfo(status);
  proto.add_details()->PackFrom(info);
  if (info.reason() == "FIELD_INVALID") {
    google::rpc::BadRequest request;
    auto* violation = request.add_field_violations();
    violation->set_field(info.metadata().at("where"));
    violation->set_description(info.metadata().at("message"));
    proto.add_details()->PackFrom(request);
  }
  if (absl::IsUnavailable(status)) {
    google::rpc::RetryInfo retry;
    retry.mutable_retry_delay()->set_seconds(kRetrySeconds);
    proto.add_details()->PackFrom(retry);
  }
  if (auto payload = status.GetPayload(kMissingBlobs); payload.has_value()) {
    google::rpc::PreconditionFailure failure;
    failure.ParseFromString(std::string(*payload));
    proto.add_details()->PackFrom(failure);
  }
  return proto;
}

void AddMetadata(absl::Status& status, const std::string& key, const std::string& value) {
  status.SetPayload(kMetadataPrefix + key, absl::Cord(value));
}

void AddMissingBlob(absl::Status& status, const std::string& sha256, int64_t size_bytes) {
  google::rpc::PreconditionFailure failure;
  if (auto payload = status.GetPayload(kMissingBlobs); payload.has_value()) {
    failure.ParseFromString(std::string(*payload));
  }
  if (failure.violations_size() >= kMaxMissingBlobs) return;
  auto* violation = failure.add_violations();
  violation->set_type("MISSING");
  violation->set_subject("blobs/" + sha256 + "/" + std::to_string(size_bytes));
  violation->set_description("upload it, then call again");
  status.SetPayload(kMissingBlobs, absl::Cord(failure.SerializeAsString()));
}

}  // namespace lambert::server

// One mapping from absl::Status to what travels.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "google/rpc/status.pb.h"

namespace lambert::server {

// Code, message and ErrorInfo (domain "lambert"): the reason and, as metadata, where, message and
// hint of the error's detail, with what AddMetadata and AddMissingBlob gave. FIELD_INVALID also has
// a BadRequest, UNAVAILABLE a RetryInfo. Never empty for an error.
google::rpc::Status ToStatusProto(const absl::Status& status);

// Adds a value that the message mentions, for programs: a key in lowerCamelCase.
void AddMetadata(absl::Status& status, const std::string& key, const std::string& value);

// Names one of the blobs without which the call cannot succeed (a PreconditionFailure); the first
// 16 of them, FindMissingBlobs tells them all.
void AddMissingBlob(absl::Status& status, const std::string& sha256, int64_t size_bytes);

}  // namespace lambert::server

// A client's stream of messages that carry the chunks of one run of bytes.
#pragma once

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/rpc/reply.h"

namespace lambert::server {

// What the first message of a stream announces.
struct Announced {
  std::string sha256;     // of all bytes
  int64_t max_bytes = 0;  // 0: nobody needs them, and End is called at once
  std::string where;      // what an error is about
};

// Calls Begin for the first message and, where that is OK, End with the bytes: once, when all are
// there and have the digest, or as soon as there are more than max_bytes. Deletes itself.
template <typename Request>
class ChunkReader : public grpc::ServerReadReactor<Request> {
 public:
  ChunkReader() { this->StartRead(&request_); }
  void OnReadDone(bool ok) final {
    if (!ok) return this->Finish(ToGrpc(IsWhole() ? End(bytes_) : Mismatch()));
    if (is_first_) {
      absl::StatusOr<Announced> announced = Begin(request_);
      if (!announced.ok()) return this->Finish(ToGrpc(announced.status()));
      is_first_ = false;
      announced_ = *std::move(announced);
      if (announced_.max_bytes == 0) return this->Finish(ToGrpc(End(bytes_)));
    }
    bytes_ += request_.data();
    if (static_cast<int64_t>(bytes_.size()) > announced_.max_bytes) {
      return this->Finish(ToGrpc(End(bytes_)));
    }
    this->StartRead(&request_);
  }
  void OnDone() final { delete this; }

 protected:
  virtual absl::StatusOr<Announced> Begin(const Request& first) = 0;
  // May move from `bytes`.
  virtual absl::Status End(std::string& bytes) = 0;

 private:
  bool IsWhole() const { return !is_first_ && Sha256Hex(bytes_) == announced_.sha256; }
  absl::Status Mismatch() const {
    return MakeError(
        absl::StatusCode::kInvalidArgument,
        {"DIGEST_MISMATCH", is_first_ ? "lease" : announced_.where,
         "the result that arrived is not the one that was announced", "send it again"});
  }

  Request request_;
  Announced announced_;
  std::string bytes_;
  bool is_first_ = true;
};

}  // namespace lambert::server

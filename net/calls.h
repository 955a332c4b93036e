// What every caller of a server needs: deadlines, chunks, statuses.
#pragma once

#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"

namespace lambert {

// 30 s and 1 s for each 4 MiB.
inline absl::Duration TransferDeadline(int64_t size_bytes) {
  return absl::Seconds(30 + size_bytes / (int64_t{4} << 20));
}

inline void SetDeadline(grpc::ClientContext& context, absl::Duration deadline) {
  context.set_deadline(absl::ToChronoTime(absl::Now() + deadline));
}

// The code and the message that the server gave.
inline absl::Status FromGrpc(const grpc::Status& status) {
  return absl::Status(static_cast<absl::StatusCode>(status.error_code()), status.error_message());
}

template <typename T>
absl::StatusOr<T> Result(const grpc::Status& status, T response) {
  if (!status.ok()) return FromGrpc(status);
  return response;
}

// True for what may pass: a server that is not there, does not answer, or goes.
inline bool IsWorthRetrying(const absl::Status& status) {
  return absl::IsUnavailable(status) || absl::IsDeadlineExceeded(status) ||
         absl::IsCancelled(status);
}

// Sends `header`, and `bytes` in its and further messages' field `data`; then the call's status.
template <typename Writer, typename Message>
absl::Status WriteInChunks(Writer& writer, Message header, const std::string& bytes) {
  constexpr size_t kChunkBytes = size_t{1} << 20;
  Message piece = std::move(header);
  size_t sent = 0;
  do {
    const size_t size = std::min(bytes.size() - sent, kChunkBytes);
    piece.set_data(bytes.data() + sent, size);
    sent += size;
    if (!writer.Write(piece)) break;  // Finish says why
    piece.Clear();
  } while (sent < bytes.size());
  writer.WritesDone();
  return FromGrpc(writer.Finish());
}

}  // namespace lambert

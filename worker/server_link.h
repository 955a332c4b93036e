// The calls that a worker makes, as plain functions: deadlines, chunks and statuses stay in here.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "lambert/worker/v1/worker_service.pb.h"

namespace grpc {
class Channel;
}

namespace lambert::worker {

// Thread safe. Every call blocks; errors carry the code and message that the server gave.
class ServerLink {
 public:
  explicit ServerLink(std::shared_ptr<grpc::Channel> channel);
  ~ServerLink();

  absl::StatusOr<v1::WorkerSession> CreateSession(const v1::CreateWorkerSessionRequest& request);
  // Waits `hold` longer than for a call that is answered at once. CANCELLED where it is
  // interrupted, or is not to begin: `is_interrupted` turns true before InterruptSync is called.
  absl::StatusOr<v1::SyncWorkerSessionResponse> Sync(const v1::SyncWorkerSessionRequest& request,
                                                     absl::Duration hold,
                                                     const std::function<bool()>& is_interrupted);
  void InterruptSync();
  absl::StatusOr<v1::SubmitUnitResultResponse> Submit(v1::SubmitUnitResultRequest header,
                                                      const std::string& bytes);
  void DeleteSession(const std::string& session);
  // Goes on from the next byte when the connection breaks, a few times.
  absl::StatusOr<std::string> Download(const std::string& sha256, int64_t size_bytes);

 private:
  struct Stubs;
  absl::Status DownloadRest(const std::string& sha256, int64_t size_bytes, std::string& bytes);

  const std::unique_ptr<Stubs> stubs_;
};

}  // namespace lambert::worker

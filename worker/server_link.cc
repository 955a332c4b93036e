#include "worker/server_link.h"

#include <grpcpp/grpcpp.h>

#include <utility>

#include "absl/synchronization/mutex.h"
#include "lambert/v1/blob_service.grpc.pb.h"
#include "lambert/worker/v1/worker_service.grpc.pb.h"
#include "net/calls.h"

namespace lambert::worker {
namespace {

constexpr int kDownloadAttempts = 5;
constexpr absl::Duration kCallDeadline = absl::Seconds(10);

}  // namespace

struct ServerLink::Stubs {
  explicit Stubs(const std::shared_ptr<grpc::Channel>& channel)
      : work(v1::WorkerService::NewStub(channel)),
        blobs(lambert::v1::BlobService::NewStub(channel)) {}
  const std::unique_ptr<v1::WorkerService::Stub> work;
  const std::unique_ptr<lambert::v1::BlobService::Stub> blobs;
  absl::Mutex mutex;
  grpc::ClientContext* sync ABSL_GUARDED_BY(mutex) = nullptr;  // that is under way
};

ServerLink::ServerLink(std::shared_ptr<grpc::Channel> channel)
    : stubs_(std::make_unique<Stubs>(channel)) {}
ServerLink::~ServerLink() = default;

absl::StatusOr<v1::WorkerSession> ServerLink::CreateSession(
    const v1::CreateWorkerSessionRequest& request) {
  grpc::ClientContext context;
  SetDeadline(context, kCallDeadline);
  v1::WorkerSession session;
  const grpc::Status status = stubs_->work->CreateWorkerSession(&context, request, &session);
  return Result(status, std::move(session));
}

absl::StatusOr<v1::SyncWorkerSessionResponse> ServerLink::Sync(
    const v1::SyncWorkerSessionRequest& request, absl::Duration hold,
    const std::function<bool()>& is_interrupted) {
  grpc::ClientContext context;
  SetDeadline(context, hold + absl::Seconds(5));
  {
    absl::MutexLock lock(&stubs_->mutex);
    if (is_interrupted()) return absl::CancelledError("interrupted");
    stubs_->sync = &context;
  }
  v1::SyncWorkerSessionResponse response;
  const grpc::Status status = stubs_->work->SyncWorkerSession(&context, request, &response);
  absl::MutexLock lock(&stubs_->mutex);
  stubs_->sync = nullptr;
  return Result(status, std::move(response));
}

void ServerLink::InterruptSync() {
  absl::MutexLock lock(&stubs_->mutex);
  if (stubs_->sync != nullptr) stubs_->sync->TryCancel();
}

absl::StatusOr<v1::SubmitUnitResultResponse> ServerLink::Submit(v1::SubmitUnitResultRequest header,
                                                                const std::string& bytes) {
  grpc::ClientContext context;
  SetDeadline(context, TransferDeadline(static_cast<int64_t>(bytes.size())));
  v1::SubmitUnitResultResponse response;
  auto writer = stubs_->work->SubmitUnitResult(&context, &response);
  const absl::Status status = WriteInChunks(*writer, std::move(header), bytes);
  if (!status.ok()) return status;
  return response;
}

void ServerLink::DeleteSession(const std::string& session) {
  grpc::ClientContext context;
  SetDeadline(context, absl::Seconds(2));
  v1::DeleteWorkerSessionRequest request;
  request.set_name(session);
  google::protobuf::Empty response;
  stubs_->work->DeleteWorkerSession(&context, request, &response);
}

absl::Status ServerLink::DownloadRest(const std::string& sha256, int64_t size_bytes,
                                      std::string& bytes) {
  grpc::ClientContext context;
  SetDeadline(context, TransferDeadline(size_bytes));
  lambert::v1::DownloadBlobRequest request;
  request.set_sha256(sha256);
  request.set_offset_bytes(static_cast<int64_t>(bytes.size()));
  auto reader = stubs_->blobs->DownloadBlob(&context, request);
  lambert::v1::DownloadBlobResponse piece;
  while (reader->Read(&piece)) {
    bytes += piece.data();
    if (static_cast<int64_t>(bytes.size()) > size_bytes) context.TryCancel();
  }
  return FromGrpc(reader->Finish());
}

absl::StatusOr<std::string> ServerLink::Download(const std::string& sha256, int64_t size_bytes) {
  std::string bytes;
  bytes.reserve(static_cast<size_t>(size_bytes));
  absl::Status status;
  for (int attempt = 0; attempt < kDownloadAttempts; ++attempt) {
    if (attempt > 0) absl::SleepFor(absl::Milliseconds(100) * (1 << attempt));
    status = DownloadRest(sha256, size_bytes, bytes);
    const bool has_cut =
        absl::IsCancelled(status) && static_cast<int64_t>(bytes.size()) <= size_bytes;
    if (!absl::IsUnavailable(status) && !has_cut) break;
  }
  if (!status.ok()) return status;
  return bytes;
}

}  // namespace lambert::worker

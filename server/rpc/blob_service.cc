#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "lambert/v1/blob_service.grpc.pb.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/coordinator.h"
#include "server/rpc/reply.h"
#include "server/rpc/services.h"

namespace lambert::server {
namespace {

constexpr size_t kChunkBytes = size_t{1} << 20;
constexpr int kMaxDigests = 10000;

absl::Status FieldInvalid(const std::string& field, const std::string& what,
                          const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", field, what, hint});
}

// Takes one piece after the other. Writing, hashing and fsync happen on the coordinator's pool.
class UploadReactor : public grpc::ServerReadReactor<v1::UploadBlobRequest> {
 public:
  UploadReactor(Coordinator* coordinator, Identity caller, v1::UploadBlobResponse* response)
      : coordinator_(coordinator), caller_(std::move(caller)), response_(response) {
    StartRead(&request_);
  }
  void OnReadDone(bool ok) override {
    if (ok) {
      coordinator_->pool().Run([this] { Take(); });
    } else {
      Finish(grpc::Status::OK);  // the client is done, or gone: what arrived stays
    }
  }
  void OnDone() override { delete this; }

 private:
  void Take() {
    if (digest_.sha256().empty()) digest_ = request_.digest();
    if (request_.data().size() > kChunkBytes) {
      return Finish(ToGrpc(FieldInvalid("data", "is larger than 1 MiB", "send smaller pieces")));
    }
    absl::StatusOr<int64_t> committed =
        coordinator_->holdings().Upload(caller_, digest_, request_.offset_bytes(), request_.data());
    if (!committed.ok()) return Finish(ToGrpc(committed.status()));
    coordinator_->traffic().uploaded_bytes += static_cast<int64_t>(request_.data().size());
    response_->set_committed_size_bytes(*committed);
    StartRead(&request_);
  }

  Coordinator* const coordinator_;
  const Identity caller_;
  v1::UploadBlobResponse* const response_;
  v1::UploadBlobRequest request_;
  v1::Digest digest_;
};

class DownloadReactor : public grpc::ServerWriteReactor<v1::DownloadBlobResponse> {
 public:
  DownloadReactor(Traffic* traffic, absl::StatusOr<std::shared_ptr<const Blob>> blob,
                  int64_t offset_bytes)
      : traffic_(traffic) {
    if (!blob.ok()) {
      Finish(ToGrpc(blob.status()));
    } else if (offset_bytes < 0 || offset_bytes > static_cast<int64_t>((*blob)->bytes().size())) {
      Finish(ToGrpc(
          MakeError(absl::StatusCode::kInvalidArgument,
                    {"OFFSET_MISMATCH", "offset_bytes", "lies outside the blob", "begin at 0"})));
    } else {
      blob_ = *std::move(blob);
      offset_ = static_cast<size_t>(offset_bytes);
      Write();
    }
  }
  void OnWriteDone(bool ok) override {
    if (ok) {
      Write();
    } else {
      Finish(grpc::Status::CANCELLED);
    }
  }
  void OnDone() override { delete this; }

 private:
  void Write() {
    const absl::string_view rest = blob_->bytes().substr(offset_);
    if (rest.empty()) return Finish(grpc::Status::OK);
    const size_t size = std::min(rest.size(), kChunkBytes);
    response_.set_data(rest.data(), size);
    offset_ += size;
    traffic_->downloaded_bytes += static_cast<int64_t>(size);
    StartWrite(&response_);
  }

  Traffic* const traffic_;
  std::shared_ptr<const Blob> blob_;
  size_t offset_ = 0;
  v1::DownloadBlobResponse response_;
};

class BlobService : public v1::BlobService::CallbackService {
 public:
  BlobService(Coordinator* coordinator, const Doors* doors)
      : coordinator_(coordinator), doors_(*doors) {}

  grpc::ServerUnaryReactor* FindMissingBlobs(grpc::CallbackServerContext* context,
                                             const v1::FindMissingBlobsRequest* request,
                                             v1::FindMissingBlobsResponse* response) override {
    return Answer(context, doors_, Guests::kClients, response,
                  [&](const Identity& caller) { return FindMissing(caller, *request); });
  }
  grpc::ServerReadReactor<v1::UploadBlobRequest>* UploadBlob(
      grpc::CallbackServerContext* context, v1::UploadBlobResponse* response) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kClients);
    if (!caller.ok()) {
      return new Refused<grpc::ServerReadReactor<v1::UploadBlobRequest>>(caller.status());
    }
    return new UploadReactor(coordinator_, *caller, response);
  }
  grpc::ServerUnaryReactor* GetBlobUpload(grpc::CallbackServerContext* context,
                                          const v1::GetBlobUploadRequest* request,
                                          v1::BlobUpload* response) override {
    return Answer(context, doors_, Guests::kClients, response, [&](const Identity& caller) {
      return coordinator_->holdings().FindUpload(caller, request->digest());
    });
  }
  grpc::ServerWriteReactor<v1::DownloadBlobResponse>* DownloadBlob(
      grpc::CallbackServerContext* context, const v1::DownloadBlobRequest* request) override {
    const absl::StatusOr<Identity> caller = doors_.Admit(*context, Guests::kClientsAndWorkers);
    if (!caller.ok()) {
      return new Refused<grpc::ServerWriteReactor<v1::DownloadBlobResponse>>(caller.status());
    }
    absl::StatusOr<std::shared_ptr<const Blob>> blob =
        FieldInvalid("sha256", "is not a SHA-256", "send 64 lower-case hexadecimal characters");
    if (IsSha256Hex(request->sha256())) {
      blob = coordinator_->holdings().Read(*caller, request->sha256());
    }
    return new DownloadReactor(&coordinator_->traffic(), std::move(blob), request->offset_bytes());
  }

 private:
  absl::StatusOr<v1::FindMissingBlobsResponse> FindMissing(
      const Identity& caller, const v1::FindMissingBlobsRequest& request) {
    if (request.digests_size() > kMaxDigests) {
      return FieldInvalid("digests", "holds more than 10,000", "ask in several calls");
    }
    for (const v1::Digest& digest : request.digests()) {
      if (!IsSha256Hex(digest.sha256())) {
        return FieldInvalid("digests.sha256", "is not a SHA-256",
                            "send 64 lower-case hexadecimal characters");
      }
    }
    return coordinator_->holdings().FindMissing(caller, request);
  }

  Coordinator* const coordinator_;
  const Doors& doors_;
};

}  // namespace

std::unique_ptr<grpc::Service> MakeBlobService(Coordinator* coordinator, const Doors* doors) {
  return std::make_unique<BlobService>(coordinator, doors);
}

}  // namespace lambert::server

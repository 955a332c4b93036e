#include "client/blobs.h"

#include <algorithm>
#include <map>

#include "client/status.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"

namespace lambert::client {
namespace {

constexpr int64_t kChunk_bytes = 1 << 20;
constexpr size_t kDigestsPerQuestion = 10'000;
constexpr std::chrono::duration<double> kQuestionDeadline{30};

// 30 s, and a second for every 4 MiB.
std::chrono::duration<double> TransferDeadline(int64_t size_bytes) {
  return std::chrono::duration<double>(30 + static_cast<double>(size_bytes) / (4 << 20));
}

// True where another client, or our own broken stream, sends the same bytes at the same time.
bool IsOvertaken(const grpc::Status& status) {
  const auto detail = GetErrorDetail(FromGrpc(status, "upload"));
  return detail && (detail->reason == "UPLOAD_REPLACED" || detail->reason == "OFFSET_MISMATCH");
}

}  // namespace

absl::Status Blobs::Upload(const std::vector<const std::string*>& files,
                           const UploadProgress& on_progress) {
  std::map<std::string, const std::string*> by_digest;
  int64_t total = 0;
  for (const std::string* bytes : files) {
    if (by_digest.emplace(Sha256Hex(*bytes), bytes).second) {
      total += static_cast<int64_t>(bytes->size());
    }
  }
  std::vector<v1::Digest> missing;
  for (auto next = by_digest.begin(); next != by_digest.end();) {
    v1::FindMissingBlobsRequest request;
    for (size_t i = 0; i < kDigestsPerQuestion && next != by_digest.end(); ++i, ++next) {
      v1::Digest* digest = request.add_digests();
      digest->set_sha256(next->first);
      digest->set_size_bytes(static_cast<int64_t>(next->second->size()));
    }
    v1::FindMissingBlobsResponse response;
    absl::Status status = caller_->Call("upload", kQuestionDeadline, [&](auto& context) {
      return stub_->FindMissingBlobs(&context, request, &response);
    });
    if (!status.ok()) return status;
    missing.insert(missing.end(), response.missing_digests().begin(),
                   response.missing_digests().end());
  }
  int64_t done = total;
  for (const v1::Digest& digest : missing) done -= digest.size_bytes();
  for (const v1::Digest& digest : missing) {
    const auto found = by_digest.find(digest.sha256());
    if (found == by_digest.end()) continue;
    absl::Status status = UploadOne(
        digest, *found->second, [&](int64_t committed) { on_progress(done + committed, total); });
    if (!status.ok()) return status;
    done += digest.size_bytes();
  }
  on_progress(total, total);
  return absl::OkStatus();
}

absl::Status Blobs::UploadOne(const v1::Digest& digest, const std::string& bytes,
                              const std::function<void(int64_t)>& on_progress) {
  const auto size = static_cast<int64_t>(bytes.size());
  return caller_->Call("upload", TransferDeadline(size), [&](grpc::ClientContext& context) {
    // Where to begin is asked anew at every attempt: the server keeps what arrived before a break.
    v1::GetBlobUploadRequest question;
    *question.mutable_digest() = digest;
    v1::BlobUpload state;
    grpc::ClientContext question_context;
    question_context.set_deadline(context.deadline());
    grpc::Status status = stub_->GetBlobUpload(&question_context, question, &state);
    if (!status.ok() || state.complete()) return status;

    v1::UploadBlobResponse response;
    auto writer = stub_->UploadBlob(&context, &response);
    int64_t offset = state.committed_size_bytes();
    do {
      v1::UploadBlobRequest request;
      if (offset == state.committed_size_bytes()) *request.mutable_digest() = digest;
      request.set_offset_bytes(offset);
      const int64_t count = std::min(kChunk_bytes, size - offset);
      request.set_data(bytes.substr(offset, count));
      offset += count;
      if (!writer->Write(request)) break;
      on_progress(offset);
    } while (offset < size);
    writer->WritesDone();
    status = writer->Finish();
    if (IsOvertaken(status)) {
      // Called away, so that it is asked again a little later how far the bytes are.
      return grpc::Status(grpc::StatusCode::UNAVAILABLE, "another client uploads the same file");
    }
    return status;
  });
}

absl::StatusOr<std::string> Blobs::Download(const BlobRef& blob, const std::string& what) {
  std::string bytes;
  absl::Status status =
      caller_->Call(what, TransferDeadline(blob.size_bytes), [&](grpc::ClientContext& context) {
        v1::DownloadBlobRequest request;
        request.set_sha256(blob.sha256);
        request.set_offset_bytes(static_cast<int64_t>(bytes.size()));
        auto reader = stub_->DownloadBlob(&context, request);
        v1::DownloadBlobResponse response;
        while (reader->Read(&response)) {
          bytes += response.data();
          caller_->Reached();
          // A server that never stops must not fill the memory.
          if (static_cast<int64_t>(bytes.size()) > blob.size_bytes) context.TryCancel();
        }
        const grpc::Status ended = reader->Finish();
        return static_cast<int64_t>(bytes.size()) > blob.size_bytes ? grpc::Status::OK : ended;
      });
  if (!status.ok()) return status;
  if (Sha256Hex(bytes) != blob.sha256) {
    return MakeError(absl::StatusCode::kDataLoss,
                     {"BLOB_CORRUPT", what, "the bytes that arrived are not those that were named",
                      "fetch again; if it stays, the server's disk is damaged"});
  }
  return bytes;
}

}  // namespace lambert::client

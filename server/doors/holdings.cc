#include "server/doors/holdings.h"

#include <set>

#include "radiosity/core/digest.h"

namespace lambert::server {

std::map<std::string, int64_t> Holdings::BlobsOf(const std::string& owner) const {
  std::map<std::string, int64_t> blobs = refs_->UploadsOf(owner);
  scenes_->AddBlobsOf(owner, blobs);
  jobs_->AddBlobsOf(owner, blobs);
  return blobs;
}

bool Holdings::Has(const Identity& who, const std::string& sha256) const {
  if (who.sees_all()) return blobs_->Has(sha256);
  if (who.is_worker()) return jobs_->IsPatchSetOfRunning(sha256) || work_->NeedsBlob(sha256);
  return BlobsOf(who.name).count(sha256) > 0;
}

absl::StatusOr<v1::Scene> Holdings::CreateScene(const Identity& who,
                                                const v1::CreateSceneRequest& request) {
  std::map<std::string, int64_t> own;
  if (!who.sees_all()) own = BlobsOf(who.name);
  return scenes_->Create(request, who.name, [&](const std::string& sha256) {
    return who.sees_all() ? blobs_->Has(sha256) : own.count(sha256) > 0;
  });
}

v1::FindMissingBlobsResponse Holdings::FindMissing(
    const Identity& who, const v1::FindMissingBlobsRequest& request) const {
  const std::map<std::string, int64_t> own =
      who.sees_all() ? std::map<std::string, int64_t>() : BlobsOf(who.name);
  v1::FindMissingBlobsResponse response;
  std::set<std::string> seen;
  for (const v1::Digest& digest : request.digests()) {
    if (!seen.insert(digest.sha256()).second) continue;
    const bool has = who.sees_all() ? blobs_->Has(digest.sha256()) : own.count(digest.sha256()) > 0;
    if (!has) *response.add_missing_digests() = digest;
  }
  return response;
}

absl::StatusOr<std::shared_ptr<const Blob>> Holdings::Read(const Identity& who,
                                                           const std::string& sha256) const {
  if (!Has(who, sha256)) return BlobNotFound(sha256);
  return blobs_->Get(sha256);
}

absl::StatusOr<v1::BlobUpload> Holdings::FindUpload(const Identity& who, const v1::Digest& digest) {
  v1::BlobUpload upload;
  upload.set_complete(IsSha256Hex(digest.sha256()) && Has(who, digest.sha256()));
  upload.set_committed_size_bytes(digest.size_bytes());
  if (upload.complete()) return upload;
  absl::StatusOr<int64_t> committed =
      uploads_->CommittedSize(digest.sha256(), digest.size_bytes(), who.name);
  if (!committed.ok()) return committed.status();
  upload.set_committed_size_bytes(*committed);
  return upload;
}

absl::StatusOr<int64_t> Holdings::Upload(const Identity& who, const v1::Digest& digest,
                                         int64_t offset_bytes, absl::string_view data) {
  const std::string& sha256 = digest.sha256();
  const bool is_named = IsSha256Hex(sha256);
  if (is_named && Has(who, sha256)) {
    if (who.name.empty()) refs_->NoteUpload(sha256, who.name, digest.size_bytes());
    return digest.size_bytes();
  }
  if (offset_bytes == 0) {
    if (absl::Status room = CheckBytes(who.name, digest.size_bytes()); !room.ok()) return room;
  }
  const bool completes = is_named && !who.name.empty() &&
                         offset_bytes + static_cast<int64_t>(data.size()) == digest.size_bytes();
  // Whoever else has the blob and gives it up meanwhile does not take it along.
  if (completes) refs_->Add(sha256);
  absl::StatusOr<int64_t> committed =
      uploads_->Write(sha256, digest.size_bytes(), offset_bytes, data, who.name);
  if (committed.ok() && *committed == digest.size_bytes()) {
    refs_->NoteUpload(sha256, who.name, digest.size_bytes());
  }
  if (completes) refs_->Release(sha256);
  return committed;
}

absl::Status Holdings::CheckBytes(const std::string& owner, int64_t more) const {
  if (owner.empty() || quotas_->options().stored_bytes == 0) return absl::OkStatus();
  int64_t used = uploads_->BytesOf(owner);
  for (const auto& [sha256, size_bytes] : BlobsOf(owner)) used += size_bytes;
  return quotas_->CheckBytes(owner, used, more);
}

}  // namespace lambert::server

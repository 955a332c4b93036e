#include "server/blobs/blob_refs.h"

#include <utility>

namespace lambert::server {

BlobRefs::BlobRefs(BlobStore* store, Duration idle, Clock clock)
    : store_(store), idle_(idle), clock_(std::move(clock)) {}

void BlobRefs::Add(const std::string& sha256) {
  absl::MutexLock lock(&mutex_);
  ++counts_[sha256];
}

void BlobRefs::Release(const std::string& sha256) {
  absl::MutexLock lock(&mutex_);
  auto count = counts_.find(sha256);
  if (count == counts_.end() || --count->second > 0) return;
  counts_.erase(count);
  DropIfUnused(sha256);
}

void BlobRefs::NoteUpload(const std::string& sha256, const std::string& owner, int64_t size_bytes,
                          Duration age) {
  absl::MutexLock lock(&mutex_);
  if (owner.empty() && counts_.count(sha256) > 0) return;
  uploads_[sha256][owner] = {clock_() - age, size_bytes};
}

void BlobRefs::ForgetUpload(const std::string& sha256, const std::string& owner) {
  absl::MutexLock lock(&mutex_);
  auto owners = uploads_.find(sha256);
  if (owners == uploads_.end() || owners->second.erase(owner) == 0) return;
  if (owners->second.empty()) uploads_.erase(owners);
  DropIfUnused(sha256);
}

std::map<std::string, int64_t> BlobRefs::UploadsOf(const std::string& owner) const {
  absl::MutexLock lock(&mutex_);
  std::map<std::string, int64_t> sizes;
  for (const auto& [sha256, owners] : uploads_) {
    if (auto upload = owners.find(owner); upload != owners.end()) {
      sizes[sha256] = upload->second.size_bytes;
    }
  }
  return sizes;
}

// Deleted under the lock: who adds the blob next finds it gone and stores it again.
void BlobRefs::DropIfUnused(const std::string& sha256) {
  if (counts_.count(sha256) == 0 && uploads_.count(sha256) == 0) store_->Delete(sha256);
}

void BlobRefs::DropIdle() {
  absl::MutexLock lock(&mutex_);
  for (auto blob = uploads_.begin(); blob != uploads_.end();) {
    std::erase_if(blob->second,
                  [&](const auto& owner) { return clock_() - owner.second.at > idle_; });
    if (!blob->second.empty()) {
      ++blob;
      continue;
    }
    const std::string sha256 = blob->first;
    blob = uploads_.erase(blob);
    DropIfUnused(sha256);
  }
}

}  // namespace lambert::server

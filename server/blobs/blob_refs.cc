#include "server/blobs/blob_refs.h"

#include <utility>
#include <vector>

namespace lambert::server {

BlobRefs::BlobRefs(BlobStore* store, Duration idle, Clock clock)
    : store_(store), idle_(idle), clock_(std::move(clock)) {}

void BlobRefs::Add(const std::string& sha256) {
  absl::MutexLock lock(&mutex_);
  ++counts_[sha256];
  uploads_.erase(sha256);
}

void BlobRefs::Release(const std::string& sha256) {
  // Deleted under the lock: who adds the blob next finds it gone and stores it again.
  absl::MutexLock lock(&mutex_);
  auto count = counts_.find(sha256);
  if (count == counts_.end() || --count->second > 0) return;
  counts_.erase(count);
  store_->Delete(sha256);
}

void BlobRefs::NoteUpload(const std::string& sha256, Duration age) {
  absl::MutexLock lock(&mutex_);
  if (counts_.count(sha256) == 0) uploads_[sha256] = clock_() - age;
}

void BlobRefs::DropIfUnused(const std::string& sha256) {
  absl::MutexLock lock(&mutex_);
  if (counts_.count(sha256) > 0) return;
  uploads_.erase(sha256);
  store_->Delete(sha256);
}

void BlobRefs::DropIdle() {
  std::vector<std::string> idle;
  {
    absl::MutexLock lock(&mutex_);
    for (const auto& [sha256, uploaded] : uploads_) {
      if (clock_() - uploaded > idle_) idle.push_back(sha256);
    }
  }
  for (const std::string& sha256 : idle) DropIfUnused(sha256);
}

}  // namespace lambert::server

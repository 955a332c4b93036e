#include <map>
#include <utility>

#include "absl/synchronization/mutex.h"
#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/blobs/blob_store.h"

namespace lambert::server {
namespace {

class MemoryBlob : public Blob {
 public:
  explicit MemoryBlob(std::string bytes) : bytes_(std::move(bytes)) {}
  absl::string_view bytes() const override { return bytes_; }

 private:
  const std::string bytes_;
};

// Bytes that the store has lent out or holds.
class Budget {
 public:
  explicit Budget(int64_t max_bytes) : left_bytes_(max_bytes) {}
  absl::Status Take(size_t size) {
    absl::MutexLock lock(&mutex_);
    if (static_cast<int64_t>(size) > left_bytes_) {
      return MakeError(absl::StatusCode::kResourceExhausted,
                       {"STORE_FULL", "blob store", "the memory set aside for blobs is used up",
                        "delete jobs and scenes, or start the server with --data DIR"});
    }
    left_bytes_ -= static_cast<int64_t>(size);
    return absl::OkStatus();
  }
  void Give(size_t size) {
    absl::MutexLock lock(&mutex_);
    left_bytes_ += static_cast<int64_t>(size);
  }

 private:
  absl::Mutex mutex_;
  int64_t left_bytes_ ABSL_GUARDED_BY(mutex_);
};

class MemoryPartialBlob : public PartialBlob {
 public:
  explicit MemoryPartialBlob(Budget* budget) : budget_(budget) {}
  ~MemoryPartialBlob() override { budget_->Give(bytes_.size()); }
  int64_t size() const override { return static_cast<int64_t>(bytes_.size()); }
  absl::Status Append(absl::string_view data) override {
    if (absl::Status room = budget_->Take(data.size()); !room.ok()) return room;
    bytes_.append(data.data(), data.size());
    return absl::OkStatus();
  }
  std::string Release() {
    budget_->Give(bytes_.size());
    return std::exchange(bytes_, {});
  }

 private:
  Budget* const budget_;
  std::string bytes_;
};

class MemoryBlobStore : public BlobStore {
 public:
  explicit MemoryBlobStore(int64_t max_bytes) : budget_(max_bytes) {}

  bool Has(const std::string& sha256) const override {
    absl::MutexLock lock(&mutex_);
    return blobs_.count(sha256) > 0;
  }

  absl::StatusOr<std::shared_ptr<const Blob>> Get(const std::string& sha256) override {
    absl::MutexLock lock(&mutex_);
    auto found = blobs_.find(sha256);
    if (found == blobs_.end()) return BlobNotFound(sha256);
    return found->second;
  }

  absl::Status Put(const std::string& sha256, std::string bytes) override {
    if (absl::Status room = budget_.Take(bytes.size()); !room.ok()) return room;
    auto blob = std::make_shared<const MemoryBlob>(std::move(bytes));
    absl::MutexLock lock(&mutex_);
    if (!blobs_.emplace(sha256, blob).second) budget_.Give(blob->bytes().size());
    return absl::OkStatus();
  }

  void Delete(const std::string& sha256) override {
    absl::MutexLock lock(&mutex_);
    auto found = blobs_.find(sha256);
    if (found == blobs_.end()) return;
    budget_.Give(found->second->bytes().size());
    blobs_.erase(found);
  }

  // Nobody restarts what is in memory.
  std::vector<StoredBlob> List() const override { return {}; }

  absl::StatusOr<std::unique_ptr<PartialBlob>> OpenPartial(const std::string&) override {
    return std::make_unique<MemoryPartialBlob>(&budget_);
  }

  absl::Status Commit(std::unique_ptr<PartialBlob> partial, const std::string& sha256) override {
    std::string bytes = static_cast<MemoryPartialBlob&>(*partial).Release();
    if (Sha256Hex(bytes) != sha256) return DigestMismatch(sha256);
    return Put(sha256, std::move(bytes));
  }

  void DropPartial(const std::string&) override {}  // gone with the PartialBlob

 private:
  Budget budget_;  // synchronizes itself
  mutable absl::Mutex mutex_;
  std::map<std::string, std::shared_ptr<const Blob>> blobs_ ABSL_GUARDED_BY(mutex_);
};

}  // namespace

std::unique_ptr<BlobStore> MakeMemoryBlobStore(int64_t max_bytes) {
  return std::make_unique<MemoryBlobStore>(max_bytes);
}

absl::Status BlobNotFound(const std::string& sha256) {
  return MakeError(absl::StatusCode::kNotFound, {"BLOB_NOT_FOUND", "blobs/" + sha256,
                                                 "there is no such blob", "upload it first"});
}

absl::Status DigestMismatch(const std::string& sha256) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"DIGEST_MISMATCH", "blobs/" + sha256,
                    "the bytes that arrived have another SHA-256", "send the same file again"});
}

}  // namespace lambert::server

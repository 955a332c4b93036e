#include "server/blobs/uploads.h"

#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/base/status_proto.h"

namespace lambert::server {
namespace {

absl::Status OffsetMismatch(const std::string& sha256, int64_t offset, int64_t committed) {
  absl::Status status = MakeError(absl::StatusCode::kInvalidArgument,
                                  {"OFFSET_MISMATCH", "blobs/" + sha256,
                                   "a piece begins at byte " + std::to_string(offset) + " where " +
                                       std::to_string(committed) + " bytes have arrived",
                                   "go on there"});
  AddMetadata(status, "committedSizeBytes", std::to_string(committed));
  return status;
}

// Names what has arrived, like a digest: no other owner's can have this name.
std::string KeyOf(const std::string& sha256, const std::string& owner) {
  return owner.empty() ? sha256 : Sha256Hex(owner + '\0' + sha256);
}

}  // namespace

Uploads::Uploads(BlobStore* store, const UploadLimits& limits, Clock clock)
    : store_(store), limits_(limits), clock_(std::move(clock)) {}

absl::Status Uploads::Check(const std::string& sha256, int64_t size_bytes) const {
  if (!IsSha256Hex(sha256)) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "digest.sha256", "is not a SHA-256",
                      "send 64 lower-case hexadecimal characters"});
  }
  if (size_bytes < 0) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"FIELD_INVALID", "digest.size_bytes", "is negative", "send the blob's size"});
  }
  if (size_bytes > limits_.blob_bytes) {
    return MakeError(absl::StatusCode::kResourceExhausted,
                     {"BLOB_TOO_LARGE", "blobs/" + sha256,
                      std::to_string(size_bytes) + " bytes are more than the limit of " +
                          std::to_string(limits_.blob_bytes),
                      "make the file smaller"});
  }
  return absl::OkStatus();
}

absl::Status Uploads::Open(const std::string& key, const std::string& owner) {
  {
    absl::MutexLock lock(&mutex_);
    if (entries_.count(key) > 0) return absl::OkStatus();
    entries_[key].owner = owner;
    entries_[key].last_use = clock_();  // busy until it is open
  }
  DropOldest();
  absl::StatusOr<std::unique_ptr<PartialBlob>> partial = store_->OpenPartial(key);
  absl::MutexLock lock(&mutex_);
  if (!partial.ok()) {
    entries_.erase(key);
    return partial.status();
  }
  entries_[key].committed_bytes = (*partial)->size();
  entries_[key].partial = *std::move(partial);
  return absl::OkStatus();
}

absl::StatusOr<int64_t> Uploads::CommittedSize(const std::string& sha256, int64_t size_bytes,
                                               const std::string& owner) {
  if (absl::Status status = Check(sha256, size_bytes); !status.ok()) return status;
  if (owner.empty() && store_->Has(sha256)) return size_bytes;
  const std::string key = KeyOf(sha256, owner);
  if (absl::Status status = Open(key, owner); !status.ok()) return status;
  absl::MutexLock lock(&mutex_);
  auto entry = entries_.find(key);
  return entry == entries_.end() ? 0 : entry->second.committed_bytes;
}

int64_t Uploads::BytesOf(const std::string& owner) {
  absl::MutexLock lock(&mutex_);
  int64_t bytes = 0;
  for (const auto& [key, entry] : entries_) {
    if (entry.owner == owner) bytes += entry.committed_bytes;
  }
  return bytes;
}

absl::StatusOr<std::unique_ptr<PartialBlob>> Uploads::Take(const std::string& key,
                                                           const std::string& sha256,
                                                           int64_t offset_bytes) {
  absl::MutexLock lock(&mutex_);
  auto entry = entries_.find(key);
  if (entry == entries_.end()) return OffsetMismatch(sha256, offset_bytes, 0);
  if (entry->second.partial == nullptr || entry->second.committed_bytes != offset_bytes) {
    return OffsetMismatch(sha256, offset_bytes, entry->second.committed_bytes);
  }
  entry->second.last_use = clock_();
  return std::move(entry->second.partial);
}

absl::StatusOr<int64_t> Uploads::Write(const std::string& sha256, int64_t size_bytes,
                                       int64_t offset_bytes, absl::string_view data,
                                       const std::string& owner) {
  if (absl::Status status = Check(sha256, size_bytes); !status.ok()) return status;
  if (owner.empty() && store_->Has(sha256)) return size_bytes;
  const std::string key = KeyOf(sha256, owner);
  if (absl::Status status = Open(key, owner); !status.ok()) return status;
  if (offset_bytes < 0 || static_cast<int64_t>(data.size()) > size_bytes - offset_bytes) {
    absl::StatusOr<int64_t> committed = CommittedSize(sha256, size_bytes, owner);
    return OffsetMismatch(sha256, offset_bytes, committed.value_or(0));
  }
  absl::StatusOr<std::unique_ptr<PartialBlob>> partial = Take(key, sha256, offset_bytes);
  if (!partial.ok()) return partial.status();

  absl::Status status = (*partial)->Append(data);
  const int64_t committed = (*partial)->size();
  const bool complete = status.ok() && committed == size_bytes;
  if (complete) status = store_->Commit(*std::move(partial), sha256);
  absl::MutexLock lock(&mutex_);
  if (complete) {
    entries_.erase(key);
  } else {
    entries_[key].committed_bytes = committed;
    entries_[key].partial = *std::move(partial);
  }
  if (!status.ok()) return status;
  return committed;
}

void Uploads::DropIdle() {
  const TimePoint now = clock_();
  Drop([&](const Entry& entry) { return now - entry.last_use > limits_.idle; });
}

void Uploads::DropOldest() {
  TimePoint oldest = TimePoint::max();
  std::string owner;  // who has most of them
  {
    absl::MutexLock lock(&mutex_);
    if (static_cast<int>(entries_.size()) <= limits_.count) return;
    std::map<std::string, int> counts;
    for (const auto& [key, entry] : entries_) {
      if (++counts[entry.owner] > counts[owner]) owner = entry.owner;
    }
    for (const auto& [key, entry] : entries_) {
      if (entry.partial != nullptr && entry.owner == owner) {
        oldest = std::min(oldest, entry.last_use);
      }
    }
  }
  Drop([&](const Entry& entry) { return entry.owner == owner && entry.last_use <= oldest; });
}

void Uploads::Drop(const std::function<bool(const Entry&)>& is_dropped) {
  std::map<std::string, Entry> dropped;
  {
    absl::MutexLock lock(&mutex_);
    for (auto it = entries_.begin(); it != entries_.end();) {
      const bool drop = it->second.partial != nullptr && is_dropped(it->second);
      if (drop) dropped.emplace(it->first, std::move(it->second));
      it = drop ? entries_.erase(it) : std::next(it);
    }
  }
  for (auto& [key, entry] : dropped) {
    entry.partial.reset();
    store_->DropPartial(key);
  }
}

}  // namespace lambert::server

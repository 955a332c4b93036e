// Uploads in progress: which bytes of which blob have arrived.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "server/base/clock.h"
#include "server/blobs/blob_store.h"

namespace lambert::server {

struct UploadLimits {
  int64_t blob_bytes = int64_t{2} << 30;  // of one blob, > 0
  int count = 100;                        // in progress at once, > 0; the oldest give way
  Duration idle = std::chrono::hours(1);  // an upload untouched for this long is forgotten
};

// Thread safe. Each client ("" for anybody) has uploads of its own: nobody learns what others send.
// Programs of a client may write to one blob at the same time; each piece has to begin where the
// bytes so far end, so whoever comes late gets OFFSET_MISMATCH and asks where to go on.
class Uploads {
 public:
  Uploads(BlobStore* store, const UploadLimits& limits, Clock clock);

  // Bytes that have arrived; without an owner, `size_bytes` for a stored blob.
  absl::StatusOr<int64_t> CommittedSize(const std::string& sha256, int64_t size_bytes,
                                        const std::string& owner = "");

  // Adds a piece; the one that completes the blob stores it. Returns the committed size. Fails with
  // FIELD_INVALID, BLOB_TOO_LARGE, OFFSET_MISMATCH, DIGEST_MISMATCH, STORE_FULL.
  absl::StatusOr<int64_t> Write(const std::string& sha256, int64_t size_bytes, int64_t offset_bytes,
                                absl::string_view data, const std::string& owner = "");

  // Bytes that have arrived of the uploads of a client that are under way.
  int64_t BytesOf(const std::string& owner);

  // Forgets uploads that nobody goes on with.
  void DropIdle();

 private:
  struct Entry {
    std::unique_ptr<PartialBlob> partial;  // null while a writer has it
    std::string owner;
    int64_t committed_bytes = 0;
    TimePoint last_use;
  };
  absl::Status Check(const std::string& sha256, int64_t size_bytes) const;
  // Takes the partial blob out of its entry, for use without the lock.
  absl::StatusOr<std::unique_ptr<PartialBlob>> Take(const std::string& key,
                                                    const std::string& sha256,
                                                    int64_t offset_bytes);
  absl::Status Open(const std::string& key, const std::string& owner);
  void DropOldest();
  void Drop(const std::function<bool(const Entry&)>& is_dropped);

  BlobStore* const store_;
  const UploadLimits limits_;
  const Clock clock_;
  absl::Mutex mutex_;
  std::map<std::string, Entry> entries_ ABSL_GUARDED_BY(mutex_);  // by KeyOf
};

}  // namespace lambert::server

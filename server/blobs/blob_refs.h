// Who needs which blob, so that blobs go when nobody does.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "absl/synchronization/mutex.h"
#include "server/base/clock.h"
#include "server/blobs/blob_store.h"

namespace lambert::server {

// Thread safe. Scenes and jobs add what they need and release it when they go.
class BlobRefs {
 public:
  // Blobs that were uploaded but are needed by nobody go after `idle`.
  BlobRefs(BlobStore* store, Duration idle, Clock clock);

  void Add(const std::string& sha256);
  // Deletes the blob with the last reference to it.
  void Release(const std::string& sha256);
  // Tells of a blob that a client uploaded so long ago. Without an owner: only that it is there,
  // which counts where nobody needs it.
  void NoteUpload(const std::string& sha256, const std::string& owner, int64_t size_bytes,
                  Duration age = {});
  // Forgets that: what the client wanted it for refers to it now.
  void ForgetUpload(const std::string& sha256, const std::string& owner);
  // What a client uploaded and was not forgotten, with its sizes.
  std::map<std::string, int64_t> UploadsOf(const std::string& owner) const;
  // Deletes blobs that were uploaded a while ago and that nobody needs.
  void DropIdle();

 private:
  struct Upload {
    TimePoint at;
    int64_t size_bytes = 0;
  };
  void DropIfUnused(const std::string& sha256) ABSL_EXCLUSIVE_LOCKS_REQUIRED(mutex_);

  BlobStore* const store_;
  const Duration idle_;
  const Clock clock_;
  mutable absl::Mutex mutex_;
  std::map<std::string, int> counts_ ABSL_GUARDED_BY(mutex_);
  std::map<std::string, std::map<std::string, Upload>> uploads_
      ABSL_GUARDED_BY(mutex_);  // by digest, then by owner
};

}  // namespace lambert::server

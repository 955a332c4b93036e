// Who needs which blob, so that blobs go when nobody does.
#pragma once

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
  // Tells of a blob that was uploaded so long ago.
  void NoteUpload(const std::string& sha256, Duration age = {});
  // Deletes blobs that were uploaded a while ago and that nobody needs.
  void DropIdle();

 private:
  void DropIfUnused(const std::string& sha256);

  BlobStore* const store_;
  const Duration idle_;
  const Clock clock_;
  absl::Mutex mutex_;
  std::map<std::string, int> counts_ ABSL_GUARDED_BY(mutex_);
  std::map<std::string, TimePoint> uploads_ ABSL_GUARDED_BY(mutex_);  // never referenced yet
};

}  // namespace lambert::server

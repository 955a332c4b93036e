// Bytes by the SHA-256 of their content.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "server/base/clock.h"

namespace lambert::server {

// Stored bytes; readable for as long as the object lives, also after the blob was deleted.
class Blob {
 public:
  virtual ~Blob() = default;
  virtual absl::string_view bytes() const = 0;
};

// Bytes on their way in. One thread at a time.
class PartialBlob {
 public:
  virtual ~PartialBlob() = default;
  virtual int64_t size() const = 0;
  // RESOURCE_EXHAUSTED (STORE_FULL) where there is no room; what was there stays.
  virtual absl::Status Append(absl::string_view data) = 0;
};

struct StoredBlob {
  std::string sha256;
  Duration age;  // since it was stored
};

// Thread safe. Requires: every `sha256` passed IsSha256Hex.
class BlobStore {
 public:
  virtual ~BlobStore() = default;
  virtual bool Has(const std::string& sha256) const = 0;
  // NOT_FOUND (BLOB_NOT_FOUND); DATA_LOSS (BLOB_CORRUPT) where the bytes no longer have the digest.
  virtual absl::StatusOr<std::shared_ptr<const Blob>> Get(const std::string& sha256) = 0;
  // Stores bytes that the server made. Requires: sha256 is Sha256Hex(bytes). STORE_FULL.
  virtual absl::Status Put(const std::string& sha256, std::string bytes) = 0;
  virtual void Delete(const std::string& sha256) = 0;
  // All stored blobs: what a restart finds.
  virtual std::vector<StoredBlob> List() const = 0;

  // What has arrived under a key (64 characters of 0-9a-f) so far, to go on with. Requires: at most
  // one at a time for a key.
  virtual absl::StatusOr<std::unique_ptr<PartialBlob>> OpenPartial(const std::string& key) = 0;
  // Makes a whole partial blob a stored one. INVALID_ARGUMENT (DIGEST_MISMATCH) where its bytes
  // have another digest; it is dropped then.
  virtual absl::Status Commit(std::unique_ptr<PartialBlob> partial, const std::string& sha256) = 0;
  // Forgets what has arrived under a key. Requires: no PartialBlob of it is open.
  virtual void DropPartial(const std::string& key) = 0;
};

// Keeps everything in memory, partial blobs included, up to `max_bytes` in all.
std::unique_ptr<BlobStore> MakeMemoryBlobStore(int64_t max_bytes);

// Keeps blobs as `folder`/blobs/DIGEST and partial ones as `folder`/partial/KEY, where a
// restarted server finds both. Bytes are hashed again when they are first read.
absl::StatusOr<std::unique_ptr<BlobStore>> MakeDirectoryBlobStore(const std::string& folder);

absl::Status BlobNotFound(const std::string& sha256);
absl::Status DigestMismatch(const std::string& sha256);

}  // namespace lambert::server

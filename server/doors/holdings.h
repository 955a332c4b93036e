// What belongs to whom.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "lambert/v1/blob_service.pb.h"
#include "server/blobs/blob_refs.h"
#include "server/blobs/blob_store.h"
#include "server/blobs/uploads.h"
#include "server/doors/identity.h"
#include "server/doors/quotas.h"
#include "server/jobs/job_store.h"
#include "server/scenes/scene_store.h"
#include "server/work/work_table.h"

namespace lambert::server {

// A digest alone opens nothing. A client has a blob where it uploaded it, or has a scene or a job
// that names it; a worker may read what units that are lent need. To anybody else a blob is not
// there, whoever may have it: who uploads one that another has has to send all of its bytes. Thread
// safe.
class Holdings {
 public:
  Holdings(BlobStore* blobs, BlobRefs* refs, Uploads* uploads, SceneStore* scenes,
           const JobStore* jobs, const Quotas* quotas, const WorkTable* work)
      : blobs_(blobs),
        refs_(refs),
        uploads_(uploads),
        scenes_(scenes),
        jobs_(jobs),
        quotas_(quotas),
        work_(work) {}

  // The blobs of a client and their sizes.
  std::map<std::string, int64_t> BlobsOf(const std::string& owner) const;
  // Makes a scene of the caller's. Fails as SceneStore::Create does. Slow.
  absl::StatusOr<v1::Scene> CreateScene(const Identity& who, const v1::CreateSceneRequest& request);
  // Those of `digests` that are not there for a caller.
  v1::FindMissingBlobsResponse FindMissing(const Identity& who,
                                           const v1::FindMissingBlobsRequest& request) const;
  // BLOB_NOT_FOUND, BLOB_CORRUPT. Requires: IsSha256Hex.
  absl::StatusOr<std::shared_ptr<const Blob>> Read(const Identity& who,
                                                   const std::string& sha256) const;
  // FIELD_INVALID, BLOB_TOO_LARGE, STORE_FULL.
  absl::StatusOr<v1::BlobUpload> FindUpload(const Identity& who, const v1::Digest& digest);
  // Adds a piece to a caller's upload; returns the bytes that have arrived. Fails as Uploads::Write
  // does, and with QUOTA_EXCEEDED.
  absl::StatusOr<int64_t> Upload(const Identity& who, const v1::Digest& digest,
                                 int64_t offset_bytes, absl::string_view data);
  // QUOTA_EXCEEDED where a client has no room for so many bytes more.
  absl::Status CheckBytes(const std::string& owner, int64_t more) const;

 private:
  bool Has(const Identity& who, const std::string& sha256) const;

  BlobStore* const blobs_;
  BlobRefs* const refs_;
  Uploads* const uploads_;
  SceneStore* const scenes_;
  const JobStore* const jobs_;
  const Quotas* const quotas_;
  const WorkTable* const work_;
};

}  // namespace lambert::server

// Scenes: manifests of blobs that were parsed once and found good.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "absl/status/statusor.h"
#include "absl/synchronization/mutex.h"
#include "lambert/v1/scene_service.pb.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/scene/scene.h"
#include "server/base/pages.h"
#include "server/base/record_store.h"
#include "server/blobs/blob_refs.h"
#include "server/blobs/blob_store.h"
#include "server/doors/identity.h"

namespace lambert::server {

// Thread safe. Parsing takes as long as the scene is large: not for gRPC's own threads.
class SceneStore {
 public:
  SceneStore(BlobStore* blobs, BlobRefs* refs, RecordStore* records, const SceneLimits& limits);

  // Finds the scenes of an earlier run again. Call it before anything else.
  absl::Status Restore();

  // Makes a scene of `owner`, who has the blobs that `has` says. FIELD_INVALID, BLOBS_MISSING,
  // SCENE_TOO_LARGE, what LoadGltf refuses and what RecordStore::Commit fails with; then nothing is
  // left behind.
  using HasBlob = std::function<bool(const std::string& sha256)>;
  absl::StatusOr<v1::Scene> Create(const v1::CreateSceneRequest& request, const std::string& owner,
                                   const HasBlob& has);
  // A scene that the caller sees, its own before those of others. SCENE_NOT_FOUND.
  absl::StatusOr<v1::Scene> Get(const std::string& name, const Identity& who) const;
  // SCENE_NOT_FOUND where others have it alone.
  absl::StatusOr<v1::Scene> GetOwn(const std::string& name, const std::string& owner) const;
  absl::StatusOr<Page<v1::Scene>> List(int page_size, const std::string& page_token,
                                       const Identity& who = {}) const;
  // SCENE_NOT_FOUND, and what RecordStore::Commit fails with: then the scene stays.
  absl::Status Delete(const v1::Scene& scene);
  // Parses a scene of `owner`. SCENE_NOT_FOUND, BLOB_CORRUPT.
  absl::StatusOr<Scene> Load(const std::string& name, const std::string& owner) const;
  // Adds the blobs that scenes of `owner` name, with their sizes.
  void AddBlobsOf(const std::string& owner, std::map<std::string, int64_t>& blobs) const;

 private:
  absl::Status CheckBlobs(const v1::Scene& scene, const HasBlob& has) const;
  // Parses a scene to see that it is good; fills in warnings and time.
  absl::Status Examine(v1::Scene& scene) const;
  absl::StatusOr<Scene> Parse(const v1::Scene& scene) const;

  BlobStore* const blobs_;
  BlobRefs* const refs_;
  RecordStore* const records_;
  const SceneLimits limits_;
  mutable absl::Mutex mutex_;
  std::map<std::string, v1::Scene> scenes_ ABSL_GUARDED_BY(mutex_);  // by KeyOf
};

}  // namespace lambert::server

#include "server/scenes/scene_store.h"

#include <algorithm>
#include <exception>
#include <utility>
#include <vector>

#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "server/base/status_proto.h"
#include "server/base/timestamp.h"
#include "server/doors/quotas.h"

namespace lambert::server {
namespace {

constexpr char kKind[] = "scenes";
constexpr char kPrefix[] = "scenes/";
constexpr int kMaxFiles = 10000;

absl::Status FieldInvalid(const std::string& field, const std::string& what,
                          const std::string& hint) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", field, what, hint});
}

absl::Status SceneNotFound(const std::string& name) {
  return MakeError(absl::StatusCode::kNotFound,
                   {"SCENE_NOT_FOUND", name, "there is no such scene", "create it first"});
}

// Each owner has scenes of its own, also of equal content, so that nobody learns what others have.
std::string KeyOf(const std::string& name, const std::string& owner) {
  return owner.empty() ? name : name + "." + owner;
}
std::string KeyOf(const v1::Scene& scene) { return KeyOf(scene.name(), scene.owner()); }
std::string IdOf(const v1::Scene& scene) { return KeyOf(scene).substr(sizeof(kPrefix) - 1); }

bool HasControlCharacter(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 127; });
}

// The main file first, the others by uri, so that equal content is an equal scene.
absl::StatusOr<v1::Scene> MakeScene(const v1::CreateSceneRequest& request) {
  if (request.files_size() == 0 || request.files_size() > kMaxFiles) {
    return FieldInvalid("files", "holds " + std::to_string(request.files_size()) + " files",
                        "send 1 to 10,000, the main one first");
  }
  std::vector<v1::SceneFile> files(request.files().begin(), request.files().end());
  std::sort(files.begin() + 1, files.end(),
            [](const auto& a, const auto& b) { return a.uri() < b.uri(); });
  v1::Scene scene;
  std::string manifest;
  for (const v1::SceneFile& file : files) {
    if (file.uri().empty() || HasControlCharacter(file.uri())) {
      return FieldInvalid("files.uri", "is empty or has a control character", "name every file");
    }
    if (!IsSha256Hex(file.digest().sha256()) || file.digest().size_bytes() < 0) {
      return FieldInvalid("files.digest", "is not a SHA-256 with a size",
                          "send 64 lower-case hexadecimal characters and the size");
    }
    manifest += file.uri() + '\0' + file.digest().sha256() + '\0' +
                std::to_string(file.digest().size_bytes()) + '\n';
    *scene.add_files() = file;
  }
  scene.set_name(kPrefix + Sha256Hex(manifest));
  scene.set_display_name(files.front().uri());
  return scene;
}

}  // namespace

SceneStore::SceneStore(BlobStore* blobs, BlobRefs* refs, RecordStore* records,
                       const SceneLimits& limits)
    : blobs_(blobs), refs_(refs), records_(records), limits_(limits) {}

absl::Status SceneStore::Restore() {
  absl::StatusOr<std::map<std::string, std::string>> records = records_->LoadAll(kKind);
  if (!records.ok()) return records.status();
  absl::MutexLock lock(&mutex_);
  for (const auto& [id, bytes] : *records) {
    v1::Scene scene;
    if (!scene.ParseFromString(bytes)) return DamagedRecord(kKind, id);
    for (const v1::SceneFile& file : scene.files()) refs_->Add(file.digest().sha256());
    scenes_[KeyOf(scene)] = scene;
  }
  return absl::OkStatus();
}

absl::StatusOr<v1::Scene> SceneStore::Create(const v1::CreateSceneRequest& request,
                                             const std::string& owner, const HasBlob& has) {
  absl::StatusOr<v1::Scene> scene = MakeScene(request);
  if (!scene.ok()) return scene.status();
  scene->set_owner(owner);
  if (absl::StatusOr<v1::Scene> known = GetOwn(scene->name(), owner); known.ok()) return known;
  if (absl::Status missing = CheckBlobs(*scene, has); !missing.ok()) return missing;
  // References first, so that no blob goes while the scene is parsed.
  for (const v1::SceneFile& file : scene->files()) {
    refs_->Add(file.digest().sha256());
    refs_->ForgetUpload(file.digest().sha256(), owner);
  }
  absl::Status status = Examine(*scene);
  if (status.ok()) {
    status = records_->Commit({{kKind, IdOf(*scene), scene->SerializeAsString()}});
  }
  if (IsOwnershipLost(status)) return status;  // the blobs may be another server's by now
  bool is_kept = false;
  if (status.ok()) {
    absl::MutexLock lock(&mutex_);
    is_kept = scenes_.emplace(KeyOf(*scene), *scene).second;  // or somebody else was faster
  }
  if (!is_kept) {
    for (const v1::SceneFile& file : scene->files()) refs_->Release(file.digest().sha256());
  }
  if (!status.ok()) return status;
  return scene;
}

absl::Status SceneStore::CheckBlobs(const v1::Scene& scene, const HasBlob& has) const {
  int64_t bytes = 0;
  for (const v1::SceneFile& file : scene.files()) {
    bytes += std::min(file.digest().size_bytes(), limits_.bytes + 1 - bytes);
    if (bytes <= limits_.bytes) continue;
    return LimitExceeded("SCENE_TOO_LARGE", scene.display_name(), "bytes of a scene's files",
                         static_cast<double>(limits_.bytes), static_cast<double>(bytes),
                         "make the scene smaller");
  }
  absl::Status missing =
      MakeError(absl::StatusCode::kFailedPrecondition,
                {"BLOBS_MISSING", scene.display_name(), "files of the scene are not on the server",
                 "upload them first"});
  bool is_complete = true;
  for (const v1::SceneFile& file : scene.files()) {
    if (has(file.digest().sha256())) continue;
    AddMissingBlob(missing, file.digest().sha256(), file.digest().size_bytes());
    is_complete = false;
  }
  return is_complete ? absl::OkStatus() : missing;
}

absl::Status SceneStore::Examine(v1::Scene& scene) const {
  absl::StatusOr<Scene> parsed = Parse(scene);
  if (!parsed.ok()) return parsed.status();
  for (const Warning& warning : parsed->warnings) {
    v1::Warning* added = scene.add_warnings();
    added->set_reason(warning.reason);
    added->set_message(warning.message);
  }
  *scene.mutable_create_time() = TimestampNow();
  return absl::OkStatus();
}

absl::StatusOr<v1::Scene> SceneStore::GetOwn(const std::string& name,
                                             const std::string& owner) const {
  absl::MutexLock lock(&mutex_);
  auto scene = scenes_.find(KeyOf(name, owner));
  if (scene == scenes_.end() || scene->second.name() != name) return SceneNotFound(name);
  return scene->second;
}

absl::StatusOr<v1::Scene> SceneStore::Get(const std::string& name, const Identity& who) const {
  absl::StatusOr<v1::Scene> own = GetOwn(name, who.name);
  if (own.ok() || !who.sees_all()) return own;
  absl::MutexLock lock(&mutex_);
  auto scene = scenes_.lower_bound(name);
  if (scene == scenes_.end() || scene->second.name() != name) return SceneNotFound(name);
  return scene->second;
}

absl::StatusOr<Page<v1::Scene>> SceneStore::List(int page_size, const std::string& page_token,
                                                 const Identity& who) const {
  absl::MutexLock lock(&mutex_);
  return TakePage(scenes_, page_size, page_token,
                  [&](const v1::Scene& scene) { return who.Sees(scene.owner()); });
}

void SceneStore::AddBlobsOf(const std::string& owner, std::map<std::string, int64_t>& blobs) const {
  absl::MutexLock lock(&mutex_);
  for (const auto& [key, scene] : scenes_) {
    if (scene.owner() != owner) continue;
    for (const v1::SceneFile& file : scene.files()) {
      blobs[file.digest().sha256()] = file.digest().size_bytes();
    }
  }
}

absl::Status SceneStore::Delete(const v1::Scene& scene) {
  if (absl::Status gone = records_->Commit({{kKind, IdOf(scene), std::nullopt}}); !gone.ok()) {
    return gone;
  }
  {
    absl::MutexLock lock(&mutex_);
    if (scenes_.erase(KeyOf(scene)) == 0)
      return SceneNotFound(scene.name());  // somebody else was faster
  }
  for (const v1::SceneFile& file : scene.files()) refs_->Release(file.digest().sha256());
  return absl::OkStatus();
}

absl::StatusOr<Scene> SceneStore::Load(const std::string& name, const std::string& owner) const {
  absl::StatusOr<v1::Scene> scene = GetOwn(name, owner);
  if (!scene.ok()) return scene.status();
  return Parse(*scene);
}

absl::StatusOr<Scene> SceneStore::Parse(const v1::Scene& scene) const {
  SceneBundle bundle;
  for (const v1::SceneFile& file : scene.files()) {
    absl::StatusOr<std::shared_ptr<const Blob>> blob = blobs_->Get(file.digest().sha256());
    if (!blob.ok()) return blob.status();
    const std::string bytes((*blob)->bytes());
    if (static_cast<int64_t>(bytes.size()) != file.digest().size_bytes()) {
      return FieldInvalid("files.digest.size_bytes", "is not the size of " + file.uri(),
                          "send the size of each file");
    }
    if (bundle.main_name.empty()) {
      bundle.main_name = file.uri();
      bundle.main_bytes = bytes;
    } else {
      bundle.files[file.uri()] = bytes;
    }
  }
  try {
    return LoadGltf(bundle, limits_);
  } catch (const std::exception& error) {  // memory exhausted, at the worst
    return MakeError(
        absl::StatusCode::kResourceExhausted,
        {"SCENE_TOO_LARGE", scene.display_name(), error.what(), "make the scene smaller"});
  }
}

}  // namespace lambert::server

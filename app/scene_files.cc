#include "app/scene_files.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "app/progress_text.h"
#include "radiosity/core/error.h"

namespace lambert::app {
namespace {

namespace fs = std::filesystem;

absl::Status Missing(const fs::path& path, const std::string& message, const std::string& hint) {
  return MakeError(absl::StatusCode::kNotFound,
                   {"SCENE_FILE_MISSING", path.string(), message, hint});
}

// Reads a file and takes its size off `budget_bytes`, which are left of `max_bytes`.
absl::StatusOr<std::string> ReadSceneFile(const fs::path& path, const std::string& hint,
                                          int64_t max_bytes, int64_t& budget_bytes) {
  std::error_code error;
  if (fs::is_directory(path, error)) return Missing(path, "this is a folder", hint);
  errno = 0;
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) return Missing(path, std::strerror(errno != 0 ? errno : ENOENT), hint);
  const auto size = static_cast<int64_t>(file.tellg());
  if (size > budget_bytes) {
    return MakeError(
        absl::StatusCode::kResourceExhausted,
        {"SCENE_TOO_LARGE", path.string(),
         "with this file the scene has more than " + FormatBytes(static_cast<double>(max_bytes)),
         "split the scene, make its textures smaller, or raise --max-scene-bytes"});
  }
  std::string bytes(static_cast<size_t>(std::max<int64_t>(size, 0)), '\0');
  file.seekg(0);
  if (size < 0 || !file.read(bytes.data(), size)) return Missing(path, "cannot be read", hint);
  budget_bytes -= size;
  return bytes;
}

// True where `uri` names a file in the scene's folder or under it.
bool StaysInFolder(const std::string& uri) {
  const fs::path path = fs::path(uri).lexically_normal();
  return !uri.empty() && path.is_relative() && *path.begin() != "..";
}

}  // namespace

absl::StatusOr<SceneBundle> ReadSceneBundle(const std::string& path, int64_t max_bytes) {
  int64_t budget_bytes = max_bytes;
  SceneBundle bundle;
  bundle.main_name = fs::path(path).filename().string();
  auto main = ReadSceneFile(path, "give the path of a .glb or .gltf file", max_bytes, budget_bytes);
  if (!main.ok()) return main.status();
  bundle.main_bytes = *std::move(main);

  auto names = ListExternalFiles(bundle.main_name, bundle.main_bytes);
  if (!names.ok()) return names.status();
  for (const std::string& name : *names) {
    if (!StaysInFolder(name)) {
      return SceneError(bundle.main_name, "names '" + name + "', which is not in its folder",
                        "export the scene as one .glb, or put the file beside it");
    }
    auto bytes =
        ReadSceneFile(fs::path(path).parent_path() / name,
                      bundle.main_name + " names this file: put it there", max_bytes, budget_bytes);
    if (!bytes.ok()) return bytes.status();
    bundle.files[name] = *std::move(bytes);
  }
  return bundle;
}

absl::StatusOr<std::string> ReadLightFile(const std::string& path, int64_t max_bytes) {
  int64_t budget_bytes = max_bytes;
  return ReadSceneFile(path, "give the path of the file", max_bytes, budget_bytes);
}

std::string SceneStem(const std::string& path) { return fs::path(path).stem().string(); }

absl::Status CheckSceneIsKept(const std::string& scene_path, const std::string& out_folder) {
  const fs::path result = fs::path(out_folder) / (SceneStem(scene_path) + ".glb");
  std::error_code ignored;  // no such result yet
  if (!fs::equivalent(scene_path, result, ignored)) return absl::OkStatus();
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"FIELD_INVALID", "-o " + out_folder,
                    "the result would overwrite the scene " + scene_path, "give another folder"});
}

}  // namespace lambert::app

#include "app/light_files.h"

#include <filesystem>
#include <utility>

#include "app/scene_files.h"
#include "radiosity/core/error.h"
#include "radiosity/output/sky_picture.h"
#include "radiosity/scene/sky_map.h"

namespace lambert::app {
namespace {

absl::Status Add(const std::string& path, std::string bytes, SceneBundle& bundle) {
  const std::string name = std::filesystem::path(path).filename().string();
  const auto [at, is_new] = bundle.files.emplace(name, std::move(bytes));
  if (is_new) return absl::OkStatus();
  return MakeError(
      absl::StatusCode::kInvalidArgument,
      {"FIELD_INVALID", path, "another file of the scene has this name", "give it another name"});
}

}  // namespace

absl::StatusOr<SceneBundle> ReadLitBundle(const std::string& scene_path, const Options& options) {
  absl::StatusOr<SceneBundle> bundle = ReadSceneBundle(scene_path, options.limits.bytes);
  if (!bundle.ok()) return bundle.status();
  for (const std::string& path : options.ies_paths) {
    absl::StatusOr<std::string> bytes = ReadLightFile(path, options.limits.bytes);
    if (!bytes.ok()) return bytes.status();
    if (auto status = Add(path, *std::move(bytes), *bundle); !status.ok()) return status;
  }
  if (options.sky_path.empty()) return bundle;
  absl::StatusOr<std::string> bytes = ReadLightFile(options.sky_path, options.limits.bytes);
  if (!bytes.ok()) return bytes.status();
  absl::StatusOr<SkyMap> sky = DecodeSkyPicture(options.sky_path, *bytes);
  if (!sky.ok()) return sky.status();
  absl::Status status = Add(options.sky_path, EncodeSkyMap(FittingSky(*std::move(sky))), *bundle);
  if (!status.ok()) return status;
  return bundle;
}

}  // namespace lambert::app

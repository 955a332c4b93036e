// Scene files from this machine's disk, as they travel to a server.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "radiosity/scene/load_gltf.h"

namespace lambert::app {

// Reads a .glb or .gltf file and the files that it names, which have to lie in its folder or under
// it. SCENE_FILE_MISSING names the file that cannot be read; SCENE_INVALID, one outside the folder;
// SCENE_TOO_LARGE, more than `max_bytes`.
absl::StatusOr<SceneBundle> ReadSceneBundle(const std::string& path,
                                            int64_t max_bytes = SceneLimits().bytes);

// Reads a file that lights a scene; SCENE_FILE_MISSING, SCENE_TOO_LARGE.
absl::StatusOr<std::string> ReadLightFile(const std::string& path, int64_t max_bytes);

// "rooms/office.glb" -> "office": names the files of a result.
std::string SceneStem(const std::string& path);

// FIELD_INVALID where the result in `out_folder` would overwrite the scene that it is made of.
absl::Status CheckSceneIsKept(const std::string& scene_path, const std::string& out_folder);

}  // namespace lambert::app

// glTF 2.0 bytes -> Scene. The only room that knows tinygltf.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// A scene as it travels: the main file and the files that it names by relative URI. Nothing is ever
// read from a disk or a network while a bundle is parsed.
struct SceneBundle {
  std::string main_name;                     // "room.glb": used in messages
  std::string main_bytes;                    // GLB or glTF JSON, told apart by the first bytes
  std::map<std::string, std::string> files;  // decoded URI -> bytes
};

// What a parsed scene may take at most; every limit is refused by name.
struct SceneLimits {
  int64_t bytes = int64_t{2} << 30;    // of all files of the bundle together
  int64_t triangles = 50'000'000;      // with instances; as many vertices may morph targets move
  int64_t instances = 2'000'000;       // of meshes, by nodes and by EXT_mesh_gpu_instancing
  int64_t image_pixels = 64'000'000;   // of one image, checked in its header before decoding
  int64_t total_pixels = 512'000'000;  // of all images that are decoded
};

// What of a file a scene has.
enum class Keep {
  kLight,       // what light needs
  kAppearance,  // and Scene::appearance, normals and tangents, and all texture coordinates
};

// Reads the default scene (or the first; or all root nodes where the file has no scene). Points and
// lines and every feature that is not read are named in Scene::warnings. Fails with SceneError
// (reason SCENE_INVALID, or EXTENSION_UNSUPPORTED for an unknown entry of extensionsRequired, or
// SCENE_TOO_LARGE) and never throws. A scene without triangles is valid here.
absl::StatusOr<Scene> LoadGltf(const SceneBundle& bundle, const SceneLimits& limits = {},
                               Keep keep = Keep::kLight);

// Relative URIs (decoded) of buffers and images that `main_bytes` names: the files that a client
// has to add to the bundle. data: URIs and GLB chunks need none.
absl::StatusOr<std::vector<std::string>> ListExternalFiles(const std::string& main_name,
                                                           const std::string& main_bytes);

}  // namespace lambert

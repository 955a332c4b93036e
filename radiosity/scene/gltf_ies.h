// Lamps of a glTF file by their photometric files (EXT_lights_ies).
#pragma once

#include <tiny_gltf.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/transform.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// The lamp of a node at `axes`; nullopt where it has none, or no axes. Its files are those that
// `scene` has (light_files.h), data: URIs, or buffer views. SceneError naming `where` for lamps
// that do not exist or cannot be read.
absl::StatusOr<std::optional<Light>> ReadIesLight(const tinygltf::Model& model, int node,
                                                  const Scene& scene,
                                                  const std::optional<Transform>& axes,
                                                  const std::string& where);

}  // namespace lambert

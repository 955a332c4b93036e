// Scenes that others made, in folders beside the project.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/scene/load_gltf.h"

namespace lambert {

// The .glb and .gltf files under that folder of the scenes beside the project, sorted; none where
// it is not there.
std::vector<std::filesystem::path> ScenesIn(const std::string& folder);
// A file with those that it names and that are there.
SceneBundle ReadBundle(const std::filesystem::path& path);

}  // namespace lambert

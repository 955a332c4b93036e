// The one wrapper of tinygltf's parser: bytes -> tinygltf::Model.
#pragma once

#include <tiny_gltf.h>

#include "absl/status/statusor.h"
#include "radiosity/scene/load_gltf.h"

namespace lambert {

// Parses the bundle without a file system, a network or an image decoder: files come from the
// bundle alone, and images stay encoded (in Image::image, or in their buffer view). Exceptions end
// here. Versions and indices are not checked.
absl::StatusOr<tinygltf::Model> ParseModel(const SceneBundle& bundle);

}  // namespace lambert

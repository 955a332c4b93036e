// The shape of a file's node hierarchy.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "absl/status/status.h"

namespace lambert {

// Sets `roots` to the root nodes of the default scene (or of the first; or all roots where the file
// has no scene). SceneError where a child does not exist, a node has two parents or is inside
// itself, or a scene names a node that is no root, or names one twice: then following children from
// `roots` meets every node at most once.
absl::Status FindRoots(const tinygltf::Model& model, std::vector<int>* roots);

}  // namespace lambert

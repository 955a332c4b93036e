// The node tree of a glTF file: what stands where.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {

// By node: where it stands; none for nodes that are not in the scene.
using NodeWorlds = std::vector<std::optional<Transform>>;

// Fills instances, node names, cameras and lights of `scene` with those of the default scene.
// SceneError naming the node for children, meshes, cameras or lights that do not exist, for nodes
// with two parents or inside themselves, and for transforms that are not finite or not affine.
// SCENE_TOO_LARGE
// for more than `most_instances` of meshes. Iterative: depth costs no stack.
absl::Status ReadNodes(const tinygltf::Model& model, int64_t most_instances, Scene* scene,
                       NodeWorlds* worlds, UnreadFeatures* unread);

}  // namespace lambert

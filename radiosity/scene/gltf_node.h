// The node tree of a glTF file: what stands where.
#pragma once

#include <tiny_gltf.h>

#include "absl/status/statusor.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {

// Fills instances, node names, cameras and point lights of `scene` with those of the default scene.
// SceneError naming the node for children, meshes, cameras or lights that do not exist, for nodes
// with two parents or inside themselves, and for transforms that are not finite or not affine.
// Iterative: depth costs no stack.
absl::Status ReadNodes(const tinygltf::Model& model, Scene* scene, UnreadFeatures* unread);

}  // namespace lambert

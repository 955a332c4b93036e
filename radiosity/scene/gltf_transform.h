// Transforms of nodes and instances, as a file gives them.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/core/transform.h"

namespace lambert {

bool IsFinite(const Transform& t);

// Translation * rotation * scale; the rotation is a quaternion x, y, z, w of any length. SceneError
// naming `where` for a rotation that is zero or not finite.
absl::StatusOr<Transform> Compose(Vec3 translation, const std::array<double, 4>& rotation,
                                  Vec3 scale, const std::string& where);

// The transform of a node in its parent: its matrix, or its translation, rotation and scale.
// SceneError naming the node where they are not of a right length, or not affine.
absl::StatusOr<Transform> LocalTransform(const tinygltf::Node& gltf, int node);

// The transforms, inside the node, of the instances of its mesh: of EXT_mesh_gpu_instancing, else
// one identity. SceneError naming the node for attributes that are not of one length or not of a
// right type; SCENE_TOO_LARGE for more than `most`, before any is made.
absl::StatusOr<std::vector<Transform>> InstanceTransforms(const tinygltf::Model& model, int node,
                                                          int64_t most);

}  // namespace lambert

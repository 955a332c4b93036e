// glTF meshes -> Mesh: triangles of every mode, with the vertices that they use.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/scene/gltf_pose.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {

// True for modes whose vertices make triangles.
bool IsTriangleMode(int mode);

// What is left of the limits of a scene.
struct MeshBudget {
  int64_t triangles = 0;
  int64_t moves = 0;  // vertices that morph targets move, for each target
};

// Mesh `index` of the file in a pose, with the texture coordinates that `materials` (those of the
// file) ask for, and with what `keep` names. Primitives that are no triangles, or have no
// positions, stay empty and are counted in `unread`. SceneError naming accessor or mesh for indices
// out of range, positions and colours that are not finite, negative colours and materials that do
// not exist; SCENE_TOO_LARGE over the budget, from which what it takes is taken. Requires: 0 <=
// index < model.meshes.size().
absl::StatusOr<Mesh> ReadMesh(const tinygltf::Model& model, const std::vector<Material>& materials,
                              int index, const Pose& pose, Keep keep, MeshBudget* budget,
                              UnreadFeatures* unread);

}  // namespace lambert

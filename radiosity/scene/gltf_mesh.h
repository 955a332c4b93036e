// glTF meshes -> Mesh: triangles of every mode, with the vertices that they use.
#pragma once

#include <tiny_gltf.h>

#include "absl/status/statusor.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {

// Mesh `index` of the file. Primitives that are no triangles, or have no positions, stay empty and
// are counted in `unread`. SceneError naming accessor or mesh for indices out of range, positions
// that are not finite and materials that do not exist; SCENE_TOO_LARGE for more than
// `most_triangles` in this mesh. Requires: 0 <= index < model.meshes.size().
absl::StatusOr<Mesh> ReadMesh(const tinygltf::Model& model, int index, int64_t most_triangles,
                              UnreadFeatures* unread);

}  // namespace lambert

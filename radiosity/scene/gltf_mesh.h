// glTF meshes -> Mesh: triangles of every mode, with the vertices that they use.
#pragma once

#include <tiny_gltf.h>

#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {

// True for modes whose vertices make triangles.
bool IsTriangleMode(int mode);

// Mesh `index` of the file, with the texture coordinates that `materials` (those of the file) ask
// for. Primitives that are no triangles, or have no positions, stay empty and
// are counted in `unread`. SceneError naming accessor or mesh for indices out of range, positions
// and colours that are not finite, negative colours and materials that do not exist;
// SCENE_TOO_LARGE for more than `most_triangles` in this mesh. Requires: 0 <= index <
// model.meshes.size().
absl::StatusOr<Mesh> ReadMesh(const tinygltf::Model& model, const std::vector<Material>& materials,
                              int index, int64_t most_triangles, UnreadFeatures* unread);

}  // namespace lambert

// KHR_draco_mesh_compression: primitives that are decoded before anything reads them.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <vector>

#include "absl/status/status.h"

namespace lambert {

// Decodes every compressed primitive of the meshes that `shown` marks, into accessors of their own
// that the primitive then names. SceneError naming the primitive for data that is malformed or
// could not hold as many triangles as it says; SCENE_TOO_LARGE for more than `most_triangles` in
// all. What Draco's headers count is checked before anything of that size is allocated. Requires: a
// flag for each mesh.
absl::Status DecodeDraco(const std::vector<bool>& shown, int64_t most_triangles,
                         tinygltf::Model* model);

}  // namespace lambert

// EXT_meshopt_compression: buffer views that are decoded before anything reads them.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>

#include "absl/status/status.h"

namespace lambert {

// Decodes every compressed buffer view of the model into a buffer of its own and lets the view name
// it. SceneError naming the view for data that is malformed or could not hold as many elements as
// it says; SCENE_TOO_LARGE for more than `most_bytes` decoded in all. Both are seen before anything
// is allocated for a view.
absl::Status DecodeMeshopt(int64_t most_bytes, tinygltf::Model* model);

}  // namespace lambert

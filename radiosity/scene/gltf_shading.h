// Vertex normals and tangents, for files that pass the appearance of a scene on.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>

#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_pose.h"
#include "radiosity/scene/scene.h"

namespace lambert {

class ShadingReader {
 public:
  // NORMAL and TANGENT of a primitive of `vertices` vertices; what cannot be read, or has fewer, is
  // left out, and so are tangents without normals. The model must outlive it.
  ShadingReader(const tinygltf::Model& model, const tinygltf::Primitive& gltf, uint64_t vertices);

  // Appends those of vertex `i`, turned as its joints turn them, to the primitive's. Fails as
  // PosedPositions::Turn does. Requires: i < vertices.
  absl::Status Copy(uint32_t i, const PosedPositions& positions, const std::string& where,
                    Primitive* primitive) const;

 private:
  std::optional<AccessorReader> normals_, tangents_;
};

// Leaves out normals where one of them is not finite or has no length, and tangents where one of
// either is, or its w is not 1 or -1; all others get the length 1.
void DropBadShading(Primitive* primitive);

}  // namespace lambert

// Vertex normals and tangents, for files that pass the appearance of a scene on.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_pose.h"
#include "radiosity/scene/scene.h"

namespace lambert {

class ShadingReader {
 public:
  // NORMAL and TANGENT of a primitive of `vertices` vertices; what cannot be read, or has fewer, is
  // left out, and so are tangents without normals. `weights`: of the morph targets; what these say
  // of either counts where they move positions, too. The model must outlive it.
  ShadingReader(const tinygltf::Model& model, const tinygltf::Primitive& gltf, uint64_t vertices,
                const std::vector<double>& weights);

  // Appends those of vertex `i`, moved by the morph targets and turned as its joints turn them, to
  // the primitive's. Fails as PosedPositions::Turn does. Requires: i < vertices.
  absl::Status Copy(uint32_t i, const PosedPositions& positions, const std::string& where,
                    Primitive* primitive) const;

 private:
  struct Directions {
    AccessorReader rest;
    std::vector<MorphOffsets> targets;
    Vec3 At(uint32_t i) const;
  };
  static std::optional<Directions> Open(const tinygltf::Model& model,
                                        const tinygltf::Primitive& gltf, const char* name, int type,
                                        uint64_t vertices, const std::vector<double>& weights);

  std::optional<Directions> normals_, tangents_;
};

// Leaves out normals where one of them is not finite or has no length, and tangents where one of
// either is, or its w is not 1 or -1; all others get the length 1.
void DropBadShading(Primitive* primitive);

}  // namespace lambert

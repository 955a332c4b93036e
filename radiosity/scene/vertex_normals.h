// Vertex normals are for shading: light needs none. What is wrong with them tells of a bad export.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <optional>

#include "radiosity/core/vec3.h"
#include "radiosity/scene/gltf_accessor.h"

namespace lambert {

class VertexNormals {
 public:
  // The NORMAL of a primitive. None, or an accessor that cannot be read: no triangle is bad. The
  // model must outlive it.
  VertexNormals(const tinygltf::Model& model, const tinygltf::Primitive& gltf);

  // Whether the normals of the triangle with vertices `indices` at `corners` are bad: one is
  // missing, not finite or longer or shorter than 1 by over 1 %, or their sum points to the back.
  bool IsBad(const std::array<uint64_t, 3>& indices, const std::array<Vec3, 3>& corners) const;

 private:
  std::optional<AccessorReader> normals_;
};

}  // namespace lambert

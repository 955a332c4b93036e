#include "radiosity/scene/vertex_normals.h"

#include <cmath>

namespace lambert {
namespace {

constexpr double kLengthTolerance = 0.01;  // normals of 8 bits a component are .7 % off

}  // namespace

VertexNormals::VertexNormals(const tinygltf::Model& model, const tinygltf::Primitive& gltf) {
  const auto normal = gltf.attributes.find("NORMAL");
  if (normal == gltf.attributes.end()) return;
  absl::StatusOr<AccessorReader> made =
      AccessorReader::Make(model, normal->second, TINYGLTF_TYPE_VEC3);
  if (made.ok()) normals_ = *std::move(made);
}

bool VertexNormals::IsBad(const std::array<uint64_t, 3>& indices,
                          const std::array<Vec3, 3>& corners) const {
  if (!normals_) return false;
  Vec3 sum;
  for (uint64_t i : indices) {
    if (i >= normals_->count()) return true;
    std::array<float, 3> read;
    normals_->Floats(i, read.data());
    const Vec3 normal{read[0], read[1], read[2]};
    // Written so that NaN is bad.
    if (!(std::fabs(Length(normal) - 1) <= kLengthTolerance)) return true;
    sum = sum + normal;
  }
  return Dot(sum, Cross(corners[1] - corners[0], corners[2] - corners[0])) < 0;
}

}  // namespace lambert

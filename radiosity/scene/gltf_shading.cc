#include "radiosity/scene/gltf_shading.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace lambert {
namespace {

std::optional<AccessorReader> OpenFor(const tinygltf::Model& model,
                                      const std::map<std::string, int>& attributes,
                                      const char* name, int type, uint64_t vertices) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return std::nullopt;
  absl::StatusOr<AccessorReader> made = AccessorReader::Make(model, found->second, type);
  if (!made.ok() || made->count() < vertices) return std::nullopt;
  return *std::move(made);
}

// Gives the first three numbers of each element the length 1; false where one cannot have it.
template <size_t N>
bool Normalise(std::vector<std::array<float, N>>& elements) {
  constexpr double kShortest = 1e-6;
  for (std::array<float, N>& element : elements) {
    const Vec3 v{element[0], element[1], element[2]};
    const double length = Length(v);
    if (!std::isfinite(length) || length < kShortest) return false;
    const std::array<float, 3> unit = ToFloats(v / length);
    for (int axis = 0; axis < 3; ++axis) element[axis] = unit[axis];
    if (N == 4 && std::fabs(element[N - 1]) != 1) return false;
  }
  return true;
}

}  // namespace

std::optional<ShadingReader::Directions> ShadingReader::Open(const tinygltf::Model& model,
                                                             const tinygltf::Primitive& gltf,
                                                             const char* name, int type,
                                                             uint64_t vertices,
                                                             const std::vector<double>& weights) {
  std::optional<AccessorReader> rest = OpenFor(model, gltf.attributes, name, type, vertices);
  if (!rest) return std::nullopt;
  Directions directions{*std::move(rest), {}};
  for (size_t t = 0; t < std::min(gltf.targets.size(), weights.size()); ++t) {
    if (weights[t] == 0 || gltf.targets[t].count("POSITION") == 0) continue;
    std::optional<AccessorReader> offsets =
        OpenFor(model, gltf.targets[t], name, TINYGLTF_TYPE_VEC3, vertices);
    if (offsets) directions.targets.push_back({weights[t], *std::move(offsets)});
  }
  return directions;
}

ShadingReader::ShadingReader(const tinygltf::Model& model, const tinygltf::Primitive& gltf,
                             uint64_t vertices, const std::vector<double>& weights)
    : normals_(Open(model, gltf, "NORMAL", TINYGLTF_TYPE_VEC3, vertices, weights)) {
  if (normals_) tangents_ = Open(model, gltf, "TANGENT", TINYGLTF_TYPE_VEC4, vertices, weights);
}

Vec3 ShadingReader::Directions::At(uint32_t i) const {
  std::array<float, 4> read;
  rest.Floats(i, read.data());
  return Morphed({read[0], read[1], read[2]}, targets, i);
}

absl::Status ShadingReader::Copy(uint32_t i, const PosedPositions& positions,
                                 const std::string& where, Primitive* primitive) const {
  if (!normals_) return absl::OkStatus();
  const absl::StatusOr<Vec3> normal = positions.Turn(i, normals_->At(i), where);
  if (!normal.ok()) return normal.status();
  primitive->normals.push_back(ToFloats(*normal));
  if (!tangents_) return absl::OkStatus();
  const absl::StatusOr<Vec3> along = positions.Turn(i, tangents_->At(i), where);
  if (!along.ok()) return along.status();
  const std::array<float, 3> turned = ToFloats(*along);
  std::array<float, 4> tangent;
  tangents_->rest.Floats(i, tangent.data());
  primitive->tangents.push_back({turned[0], turned[1], turned[2], tangent[3]});
  return absl::OkStatus();
}

void DropBadShading(Primitive* primitive) {
  if (!Normalise(primitive->normals)) primitive->normals.clear();
  if (primitive->normals.empty() || !Normalise(primitive->tangents)) primitive->tangents.clear();
}

}  // namespace lambert

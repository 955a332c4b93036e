#include "radiosity/scene/gltf_transform.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_extensions.h"

namespace lambert {
namespace {

constexpr char kExportAgain[] = "export the file again";
constexpr char kInstancing[] = "EXT_mesh_gpu_instancing";

std::string WhereOf(int node) { return absl::StrCat("node ", node); }

absl::Status NodeError(int node, const std::string& message) {
  return SceneError(WhereOf(node), message, kExportAgain);
}

Transform FromRotation(double x, double y, double z, double w) {
  return {{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)},
          {2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)},
          {2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)},
          {}};
}

absl::StatusOr<Transform> FromMatrix(const std::vector<double>& m, int node) {
  if (m.size() != 16) return NodeError(node, "its matrix has not 16 numbers");
  if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
    return NodeError(node, "its matrix is not affine: the last row is not 0 0 0 1");
  }
  return Transform{
      {m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

// Attribute `name` of the instances, if it is there. All have the count of the first.
absl::Status OpenInstances(const tinygltf::Model& model, int node, const nlohmann::json& attributes,
                           const char* name, int type, std::optional<uint64_t>* count,
                           std::optional<AccessorReader>* reader) {
  const auto found = attributes.find(name);
  if (found == attributes.end()) return absl::OkStatus();
  if (!found->is_number_integer()) {
    return NodeError(node, absl::StrCat(name, " of ", kInstancing, " is no accessor"));
  }
  absl::StatusOr<AccessorReader> made = AccessorReader::Make(model, found->get<int>(), type);
  if (!made.ok()) return made.status();
  if (count->value_or(made->count()) != made->count()) {
    return NodeError(node, absl::StrCat("attributes of ", kInstancing, " differ in their count"));
  }
  *count = made->count();
  *reader = *std::move(made);
  return absl::OkStatus();
}

// Element `i`, or `absent` where the attribute is not there.
template <size_t n>
std::array<double, n> ElementOf(const std::optional<AccessorReader>& reader, uint64_t i,
                                const std::array<double, n>& absent) {
  if (!reader) return absent;
  std::array<float, n> values;
  reader->Floats(i, values.data());
  std::array<double, n> element;
  std::copy(values.begin(), values.end(), element.begin());
  return element;
}

Vec3 ToVec3(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

bool IsFinite(const Transform& t) {
  return IsFinite(t.x) && IsFinite(t.y) && IsFinite(t.z) && IsFinite(t.translation);
}

absl::StatusOr<Transform> Compose(Vec3 translation, const std::array<double, 4>& rotation,
                                  Vec3 scale, const std::string& where) {
  const auto& [x, y, z, w] = rotation;
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  if (!(length > 0)) return SceneError(where, "its rotation is zero or not finite", kExportAgain);
  const Transform turn = FromRotation(x / length, y / length, z / length, w / length);
  return Transform{turn.x * scale.x, turn.y * scale.y, turn.z * scale.z, translation};
}

absl::StatusOr<Transform> LocalTransform(const tinygltf::Node& gltf, int node) {
  if (!gltf.matrix.empty()) return FromMatrix(gltf.matrix, node);
  const std::vector<double>&t = gltf.translation, &r = gltf.rotation, &s = gltf.scale;
  if ((!t.empty() && t.size() != 3) || (!r.empty() && r.size() != 4) ||
      (!s.empty() && s.size() != 3)) {
    return NodeError(node, "its translation, rotation or scale has a wrong length");
  }
  const Vec3 translation = t.empty() ? Vec3{} : Vec3{t[0], t[1], t[2]};
  const Vec3 scale = s.empty() ? Vec3{1, 1, 1} : Vec3{s[0], s[1], s[2]};
  if (r.empty()) {
    return Transform{{scale.x, 0, 0}, {0, scale.y, 0}, {0, 0, scale.z}, translation};
  }
  return Compose(translation, {r[0], r[1], r[2], r[3]}, scale, WhereOf(node));
}

absl::StatusOr<std::vector<Transform>> InstanceTransforms(const tinygltf::Model& model, int node,
                                                          int64_t most) {
  const nlohmann::json extension =
      FindExtension(model.nodes[node].extensions_json_string, kInstancing);
  std::optional<uint64_t> count;
  std::optional<AccessorReader> translation, rotation, scale;
  if (extension.is_object() && extension.contains("attributes")) {
    const nlohmann::json& attributes = extension["attributes"];
    absl::Status status = OpenInstances(model, node, attributes, "TRANSLATION", TINYGLTF_TYPE_VEC3,
                                        &count, &translation);
    if (status.ok()) {
      status =
          OpenInstances(model, node, attributes, "ROTATION", TINYGLTF_TYPE_VEC4, &count, &rotation);
    }
    if (status.ok()) {
      status = OpenInstances(model, node, attributes, "SCALE", TINYGLTF_TYPE_VEC3, &count, &scale);
    }
    if (!status.ok()) return status;
  }
  const uint64_t instances = count.value_or(1);
  if (most < 0 || instances > static_cast<uint64_t>(most)) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"SCENE_TOO_LARGE", WhereOf(node),
                      absl::StrCat("the scene has more instances of meshes than are allowed"),
                      "leave some out, or join them into one mesh"});
  }
  std::vector<Transform> transforms;
  transforms.reserve(instances);
  for (uint64_t i = 0; i < instances; ++i) {
    absl::StatusOr<Transform> made = Compose(
        ToVec3(ElementOf<3>(translation, i, {0, 0, 0})), ElementOf<4>(rotation, i, {0, 0, 0, 1}),
        ToVec3(ElementOf<3>(scale, i, {1, 1, 1})), WhereOf(node));
    if (!made.ok()) return made.status();
    transforms.push_back(*made);
  }
  return transforms;
}

}  // namespace lambert

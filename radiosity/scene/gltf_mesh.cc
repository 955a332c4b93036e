#include "radiosity/scene/gltf_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "absl/container/flat_hash_map.h"
#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_shading.h"
#include "radiosity/scene/vertex_normals.h"

namespace lambert {
namespace {

constexpr char kExportAgain[] = "export the file again";

uint64_t TriangleCount(int mode, uint64_t vertices) {
  if (mode == TINYGLTF_MODE_TRIANGLES) return vertices / 3;
  return vertices < 3 ? 0 : vertices - 2;
}

// Which of the listed vertices make triangle t (glTF 2.0, 3.7.2.1).
std::array<uint64_t, 3> TriangleCorners(int mode, uint64_t t) {
  switch (mode) {
    case TINYGLTF_MODE_TRIANGLE_STRIP:
      return {t, t + 1 + t % 2, t + 2 - t % 2};
    case TINYGLTF_MODE_TRIANGLE_FAN:
      return {t + 1, t + 2, 0};
    default:
      return {3 * t, 3 * t + 1, 3 * t + 2};
  }
}

// The accessors of one primitive.
struct Attributes {
  std::optional<AccessorReader> indices, positions, colors;
  std::map<int, AccessorReader> uv;      // by set
  std::optional<ShadingReader> shading;  // where it is kept

  uint64_t ListedVertices() const { return indices ? indices->count() : positions->count(); }
};

absl::Status OpenAccessor(const tinygltf::Model& model, int accessor, int type,
                          std::optional<AccessorReader>* reader) {
  absl::StatusOr<AccessorReader> made = AccessorReader::Make(model, accessor, type);
  if (made.ok()) *reader = *std::move(made);
  return made.status();
}

// The sets of texture coordinates to read: the two that unwrapped scenes have, and those of the
// material's textures.
std::set<int> UvSets(const std::vector<Material>& materials, int material) {
  std::set<int> sets = {0, 1};
  if (material < 0) return sets;
  for (const TextureUse& use :
       {materials[material].reflectance_texture, materials[material].luminance_texture}) {
    if (use.texture >= 0) sets.insert(use.uv_set);
  }
  return sets;
}

// Attribute `name` of type `type` with an element for each position, if it is there.
absl::Status OpenAttribute(const tinygltf::Model& model, const tinygltf::Primitive& gltf,
                           const std::string& name, int type, const Attributes& attributes,
                           const std::string& where, std::optional<AccessorReader>* reader) {
  const auto found = gltf.attributes.find(name);
  if (found == gltf.attributes.end()) return absl::OkStatus();
  absl::Status status = OpenAccessor(model, found->second, type, reader);
  if (status.ok() && (*reader)->count() < attributes.positions->count()) {
    return SceneError(where, absl::StrCat("it has fewer ", name, " than positions"), kExportAgain);
  }
  return status;
}

// Adds what is kept beside what light needs: what cannot be read of it is left out.
void OpenAppearance(const tinygltf::Model& model, const tinygltf::Primitive& gltf, const Pose& pose,
                    Attributes* attributes) {
  constexpr int kMostUvSets = 8;
  for (int set = 0; set < kMostUvSets; ++set) {
    if (attributes->uv.contains(set)) continue;
    std::optional<AccessorReader> uv;
    (void)OpenAttribute(model, gltf, absl::StrCat("TEXCOORD_", set), TINYGLTF_TYPE_VEC2,
                        *attributes, "", &uv);
    if (uv && uv->count() >= attributes->positions->count()) attributes->uv.emplace(set, *uv);
  }
  attributes->shading.emplace(model, gltf, attributes->positions->count(), pose.weights);
}

// COLOR_0 has three components or four.
int ColorType(const tinygltf::Model& model, const tinygltf::Primitive& gltf) {
  const auto found = gltf.attributes.find("COLOR_0");
  const bool exists = found != gltf.attributes.end() && found->second >= 0 &&
                      found->second < static_cast<int>(model.accessors.size());
  return exists && model.accessors[found->second].type == TINYGLTF_TYPE_VEC3 ? TINYGLTF_TYPE_VEC3
                                                                             : TINYGLTF_TYPE_VEC4;
}

absl::StatusOr<Attributes> OpenAttributes(const tinygltf::Model& model,
                                          const tinygltf::Primitive& gltf,
                                          const std::set<int>& uv_sets, const std::string& where) {
  Attributes attributes;
  absl::Status status = OpenAccessor(model, gltf.attributes.at("POSITION"), TINYGLTF_TYPE_VEC3,
                                     &attributes.positions);
  if (!status.ok()) return status;
  for (int set : uv_sets) {
    std::optional<AccessorReader> uv;
    status = OpenAttribute(model, gltf, absl::StrCat("TEXCOORD_", set), TINYGLTF_TYPE_VEC2,
                           attributes, where, &uv);
    if (!status.ok()) return status;
    if (uv) attributes.uv.emplace(set, *std::move(uv));
  }
  status = OpenAttribute(model, gltf, "COLOR_0", ColorType(model, gltf), attributes, where,
                         &attributes.colors);
  if (!status.ok()) return status;
  if (gltf.indices < 0) return attributes;
  status = OpenAccessor(model, gltf.indices, TINYGLTF_TYPE_SCALAR, &attributes.indices);
  if (!status.ok()) return status;
  const int type = attributes.indices->component_type();
  if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
      type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    return SceneError(where, "its indices are not unsigned integers", kExportAgain);
  }
  return attributes;
}

// Copies vertices as triangles ask for them: those that none uses cost nothing.
class VertexCopier {
 public:
  VertexCopier(const Attributes& attributes, const PosedPositions& positions, Primitive* primitive)
      : attributes_(attributes), positions_(positions), primitive_(primitive) {}

  // Index in the primitive of vertex `i` of the file.
  absl::StatusOr<uint32_t> Copy(uint32_t i, const std::string& where) {
    const uint32_t next = static_cast<uint32_t>(primitive_->positions.size());
    const auto [it, is_new] = copied_.try_emplace(i, next);
    if (!is_new) return it->second;
    const absl::StatusOr<std::array<float, 3>> position = positions_.At(i, where);
    if (!position.ok()) return position.status();
    for (float x : *position) {
      if (!std::isfinite(x)) {
        return SceneError(where, absl::StrCat("position ", i, " is not finite"), kExportAgain);
      }
    }
    primitive_->positions.push_back(*position);
    for (const auto& [set, reader] : attributes_.uv) {
      std::array<float, 2> uv;
      reader.Floats(i, uv.data());
      primitive_->uv[set].push_back(uv);
    }
    absl::Status status;
    if (attributes_.colors) status = CopyColor(i, where);
    if (status.ok() && attributes_.shading) {
      status = attributes_.shading->Copy(i, positions_, where, primitive_);
    }
    if (!status.ok()) return status;
    return next;
  }

 private:
  absl::Status CopyColor(uint32_t i, const std::string& where) {
    std::array<float, 4> color{1, 1, 1, 1};
    attributes_.colors->Floats(i, color.data());
    for (float x : color) {
      if (!std::isfinite(x) || x < 0) {
        return SceneError(where, absl::StrCat("colour ", i, " is negative or not finite"),
                          "give it values from 0 to 1");
      }
    }
    const float largest = *std::max_element(color.begin(), color.end());
    if (largest > 1) ++primitive_->clamped_colors;
    for (float& x : color) x = std::min(x, 1.0f);
    primitive_->colors.push_back(color);
    return absl::OkStatus();
  }

  const Attributes& attributes_;
  const PosedPositions& positions_;
  Primitive* primitive_;
  absl::flat_hash_map<uint32_t, uint32_t> copied_;
};

absl::Status ReadTriangles(const Attributes& attributes, const PosedPositions& positions,
                           const VertexNormals& normals, int mode, const std::string& where,
                           Primitive* primitive) {
  const uint64_t triangles = TriangleCount(mode, attributes.ListedVertices());
  VertexCopier copier(attributes, positions, primitive);
  primitive->triangles.reserve(triangles);
  for (uint64_t t = 0; t < triangles; ++t) {
    std::array<uint32_t, 3> triangle;
    std::array<uint64_t, 3> vertices = TriangleCorners(mode, t);
    std::array<Vec3, 3> corners;
    for (int k = 0; k < 3; ++k) {
      if (attributes.indices) vertices[k] = attributes.indices->Index(vertices[k]);
      const uint64_t i = vertices[k];
      if (i >= attributes.positions->count()) {
        return SceneError(where,
                          absl::StrCat("index ", i, " is not under its vertex count ",
                                       attributes.positions->count()),
                          kExportAgain);
      }
      const absl::StatusOr<uint32_t> vertex = copier.Copy(static_cast<uint32_t>(i), where);
      if (!vertex.ok()) return vertex.status();
      triangle[k] = *vertex;
      corners[k] = FromFloats(primitive->positions[*vertex]);
    }
    // Normals are those of the file: what a pose moves is not compared with them.
    if (!positions.moves() && normals.IsBad(vertices, corners)) ++primitive->bad_normals;
    primitive->triangles.push_back(triangle);
  }
  return absl::OkStatus();
}

// Morph targets at work that move more than positions and what follows them.
void CountUnread(const tinygltf::Primitive& gltf, const Pose& pose, UnreadFeatures* unread) {
  for (size_t t = 0; t < std::min(gltf.targets.size(), pose.weights.size()); ++t) {
    for (const auto& [name, accessor] : gltf.targets[t]) {
      if (pose.weights[t] == 0 || name == "POSITION" || name == "NORMAL" || name == "TANGENT") {
        continue;
      }
      unread->Add("morph targets of texture coordinates and colours", "target", "left out");
    }
  }
}

absl::StatusOr<Primitive> ReadPrimitive(const tinygltf::Model& model,
                                        const std::vector<Material>& materials,
                                        const tinygltf::Primitive& gltf, const std::string& where,
                                        const Pose& pose, Keep keep, MeshBudget* budget,
                                        UnreadFeatures* unread) {
  Primitive primitive;
  if (gltf.mode < TINYGLTF_MODE_POINTS || gltf.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    return SceneError(where, absl::StrCat("its mode ", gltf.mode, " does not exist"), kExportAgain);
  }
  if (!IsTriangleMode(gltf.mode)) {
    unread->Add("points and lines", "primitive", "left out");
    return primitive;
  }
  if (gltf.attributes.count("POSITION") == 0) {
    unread->Add("triangles without positions", "primitive", "left out");
    return primitive;
  }
  if (gltf.material < -1 || gltf.material >= static_cast<int>(model.materials.size())) {
    return SceneError(where, absl::StrCat("its material ", gltf.material, " does not exist"),
                      kExportAgain);
  }
  primitive.material = gltf.material;
  absl::StatusOr<Attributes> attributes =
      OpenAttributes(model, gltf, UvSets(materials, gltf.material), where);
  if (!attributes.ok()) return attributes.status();
  if (keep == Keep::kAppearance) OpenAppearance(model, gltf, pose, &*attributes);
  const uint64_t count = TriangleCount(gltf.mode, attributes->ListedVertices());
  if (count > static_cast<uint64_t>(budget->triangles)) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"SCENE_TOO_LARGE", where, "the scene has more triangles than are allowed",
                      "simplify its meshes"});
  }
  budget->triangles -= static_cast<int64_t>(count);
  const absl::StatusOr<PosedPositions> positions =
      PosedPositions::Open(model, gltf, pose, *attributes->positions, where, &budget->moves);
  if (!positions.ok()) return positions.status();
  CountUnread(gltf, pose, unread);
  absl::Status status = ReadTriangles(*attributes, *positions, VertexNormals(model, gltf),
                                      gltf.mode, where, &primitive);
  if (!status.ok()) return status;
  DropBadShading(&primitive);
  return primitive;
}

}  // namespace

bool IsTriangleMode(int mode) {
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

absl::StatusOr<Mesh> ReadMesh(const tinygltf::Model& model, const std::vector<Material>& materials,
                              int index, const Pose& pose, Keep keep, MeshBudget* budget,
                              UnreadFeatures* unread) {
  const tinygltf::Mesh& gltf = model.meshes[index];
  Mesh mesh;
  mesh.name = gltf.name;
  for (size_t p = 0; p < gltf.primitives.size(); ++p) {
    absl::StatusOr<Primitive> primitive =
        ReadPrimitive(model, materials, gltf.primitives[p],
                      absl::StrCat("mesh ", index, ", primitive ", p), pose, keep, budget, unread);
    if (!primitive.ok()) return primitive.status();
    mesh.primitives.push_back(*std::move(primitive));
  }
  return mesh;
}

}  // namespace lambert

#include "radiosity/scene/gltf_mesh.h"

#include <cmath>
#include <optional>

#include "absl/container/flat_hash_map.h"
#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/vertex_normals.h"

namespace lambert {
namespace {

constexpr char kExportAgain[] = "export the file again";

bool IsTriangleMode(int mode) {
  return mode == TINYGLTF_MODE_TRIANGLES || mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
         mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

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
  std::optional<AccessorReader> indices, positions;
  std::array<std::optional<AccessorReader>, 2> uv;

  uint64_t ListedVertices() const { return indices ? indices->count() : positions->count(); }
};

absl::Status OpenAccessor(const tinygltf::Model& model, int accessor, int type,
                          std::optional<AccessorReader>* reader) {
  absl::StatusOr<AccessorReader> made = AccessorReader::Make(model, accessor, type);
  if (made.ok()) *reader = *std::move(made);
  return made.status();
}

absl::StatusOr<Attributes> OpenAttributes(const tinygltf::Model& model,
                                          const tinygltf::Primitive& gltf,
                                          const std::string& where) {
  Attributes attributes;
  absl::Status status = OpenAccessor(model, gltf.attributes.at("POSITION"), TINYGLTF_TYPE_VEC3,
                                     &attributes.positions);
  if (!status.ok()) return status;
  for (int set = 0; set < 2; ++set) {
    const auto uv = gltf.attributes.find(absl::StrCat("TEXCOORD_", set));
    if (uv == gltf.attributes.end()) continue;
    status = OpenAccessor(model, uv->second, TINYGLTF_TYPE_VEC2, &attributes.uv[set]);
    if (!status.ok()) return status;
    if (attributes.uv[set]->count() < attributes.positions->count()) {
      return SceneError(where, absl::StrCat("it has fewer TEXCOORD_", set, " than positions"),
                        kExportAgain);
    }
  }
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
  VertexCopier(const Attributes& attributes, Primitive* primitive)
      : attributes_(attributes), primitive_(primitive) {}

  // Index in the primitive of vertex `i` of the file; nullopt where its position is not finite.
  std::optional<uint32_t> Copy(uint32_t i) {
    const uint32_t next = static_cast<uint32_t>(primitive_->positions.size());
    const auto [it, is_new] = copied_.try_emplace(i, next);
    if (!is_new) return it->second;
    std::array<float, 3> position;
    attributes_.positions->Floats(i, position.data());
    for (float x : position) {
      if (!std::isfinite(x)) return std::nullopt;
    }
    primitive_->positions.push_back(position);
    for (int set = 0; set < 2; ++set) {
      if (!attributes_.uv[set]) continue;
      std::array<float, 2> uv;
      attributes_.uv[set]->Floats(i, uv.data());
      primitive_->uv[set].push_back(uv);
    }
    return next;
  }

 private:
  const Attributes& attributes_;
  Primitive* primitive_;
  absl::flat_hash_map<uint32_t, uint32_t> copied_;
};

absl::Status ReadTriangles(const Attributes& attributes, const VertexNormals& normals, int mode,
                           const std::string& where, Primitive* primitive) {
  const uint64_t triangles = TriangleCount(mode, attributes.ListedVertices());
  VertexCopier copier(attributes, primitive);
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
      const std::optional<uint32_t> vertex = copier.Copy(static_cast<uint32_t>(i));
      if (!vertex) {
        return SceneError(where, absl::StrCat("position ", i, " is not finite"), kExportAgain);
      }
      triangle[k] = *vertex;
      corners[k] = FromFloats(primitive->positions[*vertex]);
    }
    if (normals.IsBad(vertices, corners)) ++primitive->bad_normals;
    primitive->triangles.push_back(triangle);
  }
  return absl::OkStatus();
}

void CountUnread(const tinygltf::Primitive& gltf, UnreadFeatures* unread) {
  if (gltf.attributes.count("COLOR_0") > 0) {
    unread->Add("vertex colours", "primitive", "left out of the reflectance");
  }
  if (!gltf.targets.empty()) unread->Add("morph targets", "primitive", "shown at rest");
}

absl::StatusOr<Primitive> ReadPrimitive(const tinygltf::Model& model,
                                        const tinygltf::Primitive& gltf, const std::string& where,
                                        int64_t* triangles_left, UnreadFeatures* unread) {
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
  absl::StatusOr<Attributes> attributes = OpenAttributes(model, gltf, where);
  if (!attributes.ok()) return attributes.status();
  const uint64_t count = TriangleCount(gltf.mode, attributes->ListedVertices());
  if (count > static_cast<uint64_t>(*triangles_left)) {
    return MakeError(absl::StatusCode::kInvalidArgument,
                     {"SCENE_TOO_LARGE", where, "the scene has more triangles than are allowed",
                      "simplify its meshes"});
  }
  *triangles_left -= static_cast<int64_t>(count);
  CountUnread(gltf, unread);
  absl::Status status =
      ReadTriangles(*attributes, VertexNormals(model, gltf), gltf.mode, where, &primitive);
  if (!status.ok()) return status;
  return primitive;
}

}  // namespace

absl::StatusOr<Mesh> ReadMesh(const tinygltf::Model& model, int index, int64_t most_triangles,
                              UnreadFeatures* unread) {
  const tinygltf::Mesh& gltf = model.meshes[index];
  Mesh mesh;
  mesh.name = gltf.name;
  for (size_t p = 0; p < gltf.primitives.size(); ++p) {
    absl::StatusOr<Primitive> primitive =
        ReadPrimitive(model, gltf.primitives[p], absl::StrCat("mesh ", index, ", primitive ", p),
                      &most_triangles, unread);
    if (!primitive.ok()) return primitive.status();
    mesh.primitives.push_back(*std::move(primitive));
  }
  return mesh;
}

}  // namespace lambert

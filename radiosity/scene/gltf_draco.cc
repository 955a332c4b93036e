#include "radiosity/scene/gltf_draco.h"

#include <draco/compression/decode.h>
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#include <draco/core/varint_decoding.h>

#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_extensions.h"

namespace lambert {
namespace {

constexpr char kExtension[] = "KHR_draco_mesh_compression";

// A plane grid, as regular as can be, takes a byte for two of its triangles.
constexpr uint64_t kMostTrianglesPerByte = 64;
// glTF names a dozen attributes; each costs memory for every point.
constexpr int kMostAttributes = 32, kMostComponents = 16;

absl::Status Malformed(const std::string& where, const std::string& what) {
  return SceneError(where, absl::StrCat(what, " (", kExtension, ")"),
                    "compress the file again, or export it without compression");
}

absl::Status TooManyTriangles(const std::string& where) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"SCENE_TOO_LARGE", where, "the scene has more triangles than are allowed",
                    "simplify its meshes"});
}

// What stopped a decoder that is bounded.
struct Bound {
  uint64_t most_triangles = 0, bytes = 0;
  bool too_large = false, implausible = false;

  // Draco allocates by these two counts before it reads on.
  bool Allows(uint64_t triangles, uint64_t points) {
    too_large = triangles > most_triangles;
    implausible = triangles > bytes * kMostTrianglesPerByte || points > 3 * triangles;
    return !too_large && !implausible;
  }
};

// A decoder of Draco that stops where a header asks for too much.
template <typename Decoder>
class BoundedDecoder : public Decoder {
 public:
  // `vertices_first`: which of the two counts of its connectivity comes first.
  BoundedDecoder(bool vertices_first, Bound* bound)
      : vertices_first_(vertices_first), bound_(bound) {}

 protected:
  bool DecodeConnectivity() override {
    draco::DecoderBuffer ahead = *this->buffer();
    uint32_t first = 0, second = 0;
    if (!draco::DecodeVarint(&first, &ahead) || !draco::DecodeVarint(&second, &ahead)) return false;
    if (vertices_first_) std::swap(first, second);
    return bound_->Allows(first, second) && Decoder::DecodeConnectivity();
  }

  // By now the attributes are known by their headers, and none has values.
  bool DecodeAllAttributes() override {
    const draco::PointCloud& cloud = *this->point_cloud();
    bound_->implausible = cloud.num_attributes() > kMostAttributes;
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      if (cloud.attribute(i)->num_components() > kMostComponents) bound_->implausible = true;
    }
    return !bound_->implausible && Decoder::DecodeAllAttributes();
  }

 private:
  const bool vertices_first_;
  Bound* bound_;
};

std::unique_ptr<draco::MeshDecoder> MakeDecoder(const draco::DracoHeader& header, Bound* bound) {
  // glTF has this one version of the bitstream.
  if (header.version_major != 2 || header.version_minor != 2 ||
      header.encoder_type != draco::TRIANGULAR_MESH) {
    return nullptr;
  }
  if (header.encoder_method == draco::MESH_EDGEBREAKER_ENCODING) {
    return std::make_unique<BoundedDecoder<draco::MeshEdgebreakerDecoder>>(true, bound);
  }
  return std::make_unique<BoundedDecoder<draco::MeshSequentialDecoder>>(false, bound);
}

absl::StatusOr<std::unique_ptr<draco::Mesh>> DecodeMesh(const ByteSpan& bytes,
                                                        uint64_t most_triangles,
                                                        const std::string& where) {
  draco::DecoderBuffer buffer, ahead;
  buffer.Init(reinterpret_cast<const char*>(bytes.data), bytes.size);
  ahead = buffer;
  draco::DracoHeader header;
  if (!draco::PointCloudDecoder::DecodeHeader(&ahead, &header).ok()) {
    return Malformed(where, "its data is not Draco's");
  }
  Bound bound{most_triangles, bytes.size};
  const std::unique_ptr<draco::MeshDecoder> decoder = MakeDecoder(header, &bound);
  if (decoder == nullptr) return Malformed(where, "its data is no Draco mesh of version 2.2");
  auto mesh = std::make_unique<draco::Mesh>();
  const draco::Status status = decoder->Decode(draco::DecoderOptions(), &buffer, mesh.get());
  if (bound.too_large) return TooManyTriangles(where);
  if (bound.implausible) return Malformed(where, "its bytes cannot hold what they say");
  if (!status.ok()) return Malformed(where, "its data is damaged");
  return mesh;
}

// Adds an accessor like `like` over `data`; returns its index.
int AddAccessor(tinygltf::Accessor like, uint64_t count, std::vector<unsigned char> data,
                tinygltf::Model* model) {
  tinygltf::Buffer buffer;
  buffer.data = std::move(data);
  tinygltf::BufferView view;
  view.buffer = static_cast<int>(model->buffers.size());
  view.byteLength = buffer.data.size();
  like.bufferView = static_cast<int>(model->bufferViews.size());
  like.byteOffset = 0;
  like.count = count;
  like.sparse.isSparse = false;
  model->buffers.push_back(std::move(buffer));
  model->bufferViews.push_back(std::move(view));
  model->accessors.push_back(std::move(like));
  return static_cast<int>(model->accessors.size()) - 1;
}

template <typename T>
bool CopyValues(const draco::PointAttribute& attribute, uint32_t points, int components,
                std::vector<unsigned char>* data) {
  data->resize(sizeof(T) * points * components);
  std::vector<T> value(components);
  for (uint32_t p = 0; p < points; ++p) {
    const draco::AttributeValueIndex at = attribute.mapped_index(draco::PointIndex(p));
    if (!attribute.ConvertValue<T>(at, static_cast<int8_t>(components), value.data())) return false;
    std::memcpy(data->data() + sizeof(T) * p * components, value.data(), sizeof(T) * components);
  }
  return true;
}

// The values of every point as the accessor has them; false for types that glTF does not know.
bool CopyAttribute(const draco::PointAttribute& attribute, uint32_t points,
                   const tinygltf::Accessor& accessor, std::vector<unsigned char>* data) {
  const int components = tinygltf::GetNumComponentsInType(accessor.type);
  if (components < 1 || components > 4) return false;
  switch (accessor.componentType) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return CopyValues<int8_t>(attribute, points, components, data);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return CopyValues<uint8_t>(attribute, points, components, data);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return CopyValues<int16_t>(attribute, points, components, data);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return CopyValues<uint16_t>(attribute, points, components, data);
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return CopyValues<float>(attribute, points, components, data);
    default:
      return false;
  }
}

void SetIndices(const draco::Mesh& mesh, tinygltf::Primitive* primitive, tinygltf::Model* model) {
  std::vector<unsigned char> data(size_t{12} * mesh.num_faces());
  for (uint32_t f = 0; f < mesh.num_faces(); ++f) {
    const draco::Mesh::Face& face = mesh.face(draco::FaceIndex(f));
    for (int k = 0; k < 3; ++k) {
      const uint32_t point = face[k].value();
      std::memcpy(&data[size_t{12} * f + 4 * k], &point, sizeof point);
    }
  }
  tinygltf::Accessor indices;
  indices.type = TINYGLTF_TYPE_SCALAR;
  indices.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  primitive->indices = AddAccessor(indices, uint64_t{3} * mesh.num_faces(), std::move(data), model);
  primitive->mode = TINYGLTF_MODE_TRIANGLES;
}

absl::Status SetAttributes(const draco::Mesh& mesh, const nlohmann::json& names,
                           const std::string& where, tinygltf::Primitive* primitive,
                           tinygltf::Model* model) {
  if (!names.is_object() || names.size() > kMostAttributes) {
    return Malformed(where, "its attributes are no short list");
  }
  for (const auto& [name, id] : names.items()) {
    const auto named = primitive->attributes.find(name);
    if (named == primitive->attributes.end()) continue;
    const draco::PointAttribute* attribute =
        id.is_number_unsigned() ? mesh.GetAttributeByUniqueId(id.get<uint32_t>()) : nullptr;
    if (attribute == nullptr || named->second < 0 ||
        named->second >= static_cast<int>(model->accessors.size())) {
      return Malformed(where, absl::StrCat("its ", name, " does not exist"));
    }
    const tinygltf::Accessor accessor = model->accessors[named->second];
    std::vector<unsigned char> data;
    if (!CopyAttribute(*attribute, mesh.num_points(), accessor, &data)) {
      return Malformed(where, absl::StrCat("its ", name, " is of no type of glTF"));
    }
    named->second = AddAccessor(accessor, mesh.num_points(), std::move(data), model);
  }
  return absl::OkStatus();
}

absl::Status DecodePrimitive(const nlohmann::json& extension, const std::string& where,
                             uint64_t* triangles_left, tinygltf::Primitive* primitive,
                             tinygltf::Model* model) {
  const auto view = extension.find("bufferView");
  const absl::StatusOr<ByteSpan> bytes = FindBufferView(
      *model, view != extension.end() && view->is_number_integer() ? view->get<int>() : -1);
  if (!bytes.ok()) return bytes.status();
  const absl::StatusOr<std::unique_ptr<draco::Mesh>> mesh =
      DecodeMesh(*bytes, *triangles_left, where);
  if (!mesh.ok()) return mesh.status();
  *triangles_left -= (*mesh)->num_faces();
  SetIndices(**mesh, primitive, model);
  return SetAttributes(**mesh, extension.value("attributes", nlohmann::json()), where, primitive,
                       model);
}

}  // namespace

absl::Status DecodeDraco(const std::vector<bool>& shown, int64_t most_triangles,
                         tinygltf::Model* model) {
  uint64_t triangles_left = static_cast<uint64_t>(most_triangles);
  for (size_t m = 0; m < model->meshes.size(); ++m) {
    for (size_t p = 0; shown[m] && p < model->meshes[m].primitives.size(); ++p) {
      tinygltf::Primitive& primitive = model->meshes[m].primitives[p];
      const nlohmann::json extension = FindExtension(primitive.extensions_json_string, kExtension);
      if (!extension.is_object()) continue;
      const std::string where = absl::StrCat("mesh ", m, ", primitive ", p);
      absl::Status status = DecodePrimitive(extension, where, &triangles_left, &primitive, model);
      if (!status.ok()) return status;
    }
  }
  return absl::OkStatus();
}

}  // namespace lambert

#include "radiosity/output/glb_writer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "radiosity/core/bounds.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;          // glTF bufferView.target
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;  // accessor.componentType

GlbWriter::Json Accessor(size_t view, size_t offset, int component, int components, size_t count) {
  const char* const types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return {{"bufferView", view},
          {"byteOffset", offset},
          {"componentType", component},
          {"type", types[components - 1]},
          {"count", count}};
}

}  // namespace

GlbWriter::GlbWriter() {
  root_["asset"] = {{"version", "2.0"}, {"generator", "Lambert"}};
  root_["scene"] = 0;
  root_["scenes"] = {{{"nodes", Json::array()}}};
}

size_t GlbWriter::Add(const char* list, Json item) {
  root_[list].push_back(std::move(item));
  return root_[list].size() - 1;
}

void GlbWriter::AddNode(Json node) {
  root_["scenes"][0]["nodes"].push_back(root_["nodes"].size());
  root_["nodes"].push_back(std::move(node));
}

void GlbWriter::AddMeshNode(const PatchSet& patches, int32_t source_node, size_t mesh) {
  const size_t named = static_cast<size_t>(source_node);
  const std::string name = named < patches.node_names.size() ? patches.node_names[named] : "";
  Json node = {{"mesh", mesh}, {"extras", {{"source_node", source_node}}}};
  if (!name.empty()) root_["meshes"][mesh]["name"] = node["name"] = name;
  if (patches.origin != Vec3{}) {
    node["translation"] = {patches.origin.x, patches.origin.y, patches.origin.z};
  }
  AddNode(std::move(node));
}

void GlbWriter::AddCamera(const View& view, const PatchSet& patches) {
  const double far = 10 * (BoundsOf(patches).Diagonal() + Length(view.eye));
  const double near = 1e-4 * far;
  Json camera;
  if (view.perspective) {
    camera = {{"type", "perspective"},
              {"perspective",
               {{"yfov", 2 * std::atan(view.half_height)},
                {"aspectRatio", view.aspect},
                {"znear", near},
                {"zfar", far}}}};
  } else {
    camera = {{"type", "orthographic"},
              {"orthographic",
               {{"xmag", view.half_height * view.aspect},
                {"ymag", view.half_height},
                {"znear", 0},
                {"zfar", far}}}};
  }
  const Vec3 eye = patches.origin + view.eye;
  const Vec3 r = view.right, u = view.up, back = -view.forward;
  AddNode(
      {{"name", "view"},
       {"camera", Add("cameras", std::move(camera))},
       {"matrix",
        {r.x, r.y, r.z, 0, u.x, u.y, u.z, 0, back.x, back.y, back.z, 0, eye.x, eye.y, eye.z, 1}}});
}

void GlbWriter::UseExtension(const std::string& name) {
  Json& used = root_["extensionsUsed"];
  if (std::find(used.begin(), used.end(), name) == used.end()) used.push_back(name);
}

GlbWriter::Json GlbWriter::UnlitMaterial(const std::string& name) {
  UseExtension("KHR_materials_unlit");
  return {{"name", name},
          {"extensions", {{"KHR_materials_unlit", Json::object()}}},
          {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
          {"doubleSided", false}};
}

size_t GlbWriter::AddVertices(const void* records, size_t count, size_t stride) {
  return AddView(records, count * stride, kArrayBuffer, stride);
}

size_t GlbWriter::AddAttribute(size_t view, size_t offset, Type type, int components,
                               size_t count) {
  const bool is_float = type == Type::kFloat;
  Json accessor = Accessor(view, offset, is_float ? kFloat : kUnsignedShort, components, count);
  if (!is_float) accessor["normalized"] = true;
  return Add("accessors", std::move(accessor));
}

size_t GlbWriter::AddPositions(size_t view, const void* records, size_t count, size_t stride,
                               size_t offset) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> low = {kInfinity, kInfinity, kInfinity};
  std::array<float, 3> high = {-kInfinity, -kInfinity, -kInfinity};
  for (size_t i = 0; i < count; ++i) {
    std::array<float, 3> position;
    std::memcpy(position.data(), static_cast<const char*>(records) + i * stride + offset,
                sizeof(position));
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], position[axis]);
      high[axis] = std::max(high[axis], position[axis]);
    }
  }
  Json accessor = Accessor(view, offset, kFloat, 3, count);
  accessor["min"] = low;
  accessor["max"] = high;
  return Add("accessors", std::move(accessor));
}

size_t GlbWriter::AddIndices(const std::vector<uint32_t>& indices) {
  const size_t view =
      AddView(indices.data(), indices.size() * sizeof(uint32_t), kElementArrayBuffer, 0);
  return Add("accessors", Accessor(view, 0, kUnsignedInt, 1, indices.size()));
}

size_t GlbWriter::AddTexture(const std::string& bytes, const std::string& mime_type,
                             const Json& sampler) {
  const size_t image = AddImage(bytes, mime_type);
  return Add("textures", {{"source", image}, {"sampler", Add("samplers", sampler)}});
}

size_t GlbWriter::AddImage(const std::string& bytes, const std::string& mime_type) {
  return Add("images", {{"bufferView", AddBytes(bytes)}, {"mimeType", mime_type}});
}

size_t GlbWriter::AddBytes(const std::string& bytes) {
  return AddView(bytes.data(), bytes.size(), 0, 0);
}

size_t GlbWriter::AddView(const void* data, size_t size, int target, size_t stride) {
  Json view = {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}};
  if (target > 0) view["target"] = target;
  if (stride > 0) view["byteStride"] = stride;
  binary_.append(static_cast<const char*>(data), size);
  binary_.resize((binary_.size() + 3) / 4 * 4);  // offsets stay multiples of 4
  return Add("bufferViews", std::move(view));
}

absl::StatusOr<std::string> GlbWriter::Finish() {
  root_["buffers"] = {{{"byteLength", binary_.size()}}};
  std::string json = root_.dump(-1, ' ', false, Json::error_handler_t::replace);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  constexpr size_t kHeaders = 12 + 8 + 8;
  const size_t size = kHeaders + json.size() + binary_.size();
  if (size > std::numeric_limits<uint32_t>::max()) {
    return MakeError(
        absl::StatusCode::kResourceExhausted,
        {"OUTPUT_TOO_LARGE", "GLB file", "it would pass 4 GiB", "bake with a larger --max-edge"});
  }
  std::string glb;
  glb.reserve(size);
  auto word = [&](size_t value) {
    for (int byte = 0; byte < 4; ++byte) glb.push_back(static_cast<char>(value >> 8 * byte));
  };
  glb += "glTF";
  word(2);
  word(size);
  word(json.size());
  glb += "JSON" + json;
  word(binary_.size());
  glb += std::string("BIN\0", 4) + binary_;
  return glb;
}

}  // namespace lambert

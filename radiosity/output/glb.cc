#include "radiosity/output/glb.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <unordered_map>
#include <vector>

#include "radiosity/core/bounds.h"
#include "radiosity/core/error.h"
#include "radiosity/output/float_value.h"

namespace lambert {
namespace {

using Json = nlohmann::json;

// One vertex of the file; 32 bytes, interleaved.
struct Vertex {
  std::array<float, 3> position;
  std::array<float, 3> irradiance_lx;
  std::array<uint16_t, 4> color;  // red, green, blue, alpha; normalised
  bool operator==(const Vertex&) const = default;
};
static_assert(sizeof(Vertex) == 32);

struct VertexHash {
  size_t operator()(const Vertex& vertex) const {
    std::array<uint64_t, sizeof(Vertex) / 8> words;
    std::memcpy(words.data(), &vertex, sizeof(Vertex));
    uint64_t hash = 0;
    for (uint64_t word : words) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

// The triangles of one node, with equal vertices stored once.
struct NodeMesh {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
};

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;          // glTF bufferView.target
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;  // accessor.componentType
constexpr uint16_t kOpaque = 65535;

using CornerValues = std::vector<std::array<Rgb, 3>>;

Vertex MakeVertex(const PatchSet& patches, const CornerValues& irradiance_lx,
                  const Exposure& exposure, PatchIndex i, int corner) {
  Vertex vertex;
  const Vec3 p = patches.corners[i][corner];
  vertex.position = {FloatValue(p.x), FloatValue(p.y), FloatValue(p.z)};
  const Rgb irradiance = irradiance_lx[i][corner];
  const Rgb display =
      Develop(patches.exitance_lm_per_m2[i] + patches.reflectance[i] * irradiance, exposure);
  for (int channel = 0; channel < 3; ++channel) {
    vertex.irradiance_lx[channel] = FloatValue(irradiance[channel]);
    vertex.color[channel] = static_cast<uint16_t>(std::lround(kOpaque * display[channel]));
  }
  vertex.color[3] = kOpaque;
  return vertex;
}

std::map<int32_t, NodeMesh> MakeMeshes(const PatchSet& patches, const CornerValues& irradiance_lx,
                                       const Exposure& exposure) {
  std::map<int32_t, std::vector<PatchIndex>> by_node;
  for (PatchIndex i = 0; i < patches.size(); ++i) by_node[patches.source[i].node].push_back(i);
  std::map<int32_t, NodeMesh> meshes;
  for (const auto& [node, members] : by_node) {
    NodeMesh& mesh = meshes[node];
    std::unordered_map<Vertex, uint32_t, VertexHash> known;
    for (PatchIndex i : members) {
      for (int corner = 0; corner < 3; ++corner) {
        const Vertex vertex = MakeVertex(patches, irradiance_lx, exposure, i, corner);
        const auto [found, is_new] =
            known.try_emplace(vertex, static_cast<uint32_t>(mesh.vertices.size()));
        if (is_new) mesh.vertices.push_back(vertex);
        mesh.indices.push_back(found->second);
      }
    }
  }
  return meshes;
}

// Puts JSON and binary parts together; offsets stay multiples of 4.
class GlbWriter {
 public:
  GlbWriter() {
    root_["asset"] = {{"version", "2.0"}, {"generator", "Lambert"}};
    root_["extensionsUsed"] = {"KHR_materials_unlit"};
    root_["materials"] = {{{"name", "radiosity"},
                           {"extensions", {{"KHR_materials_unlit", Json::object()}}},
                           {"pbrMetallicRoughness", {{"metallicFactor", 0}}},
                           {"doubleSided", false}}};
    root_["scene"] = 0;
    root_["scenes"] = {{{"nodes", Json::array()}}};
  }

  Json& root() { return root_; }

  // Index of a new node at the top of the scene.
  void AddNode(Json node) {
    root_["scenes"][0]["nodes"].push_back(root_["nodes"].size());
    root_["nodes"].push_back(std::move(node));
  }

  // Index of a new mesh of one primitive.
  size_t AddMesh(const std::string& name, const NodeMesh& mesh) {
    const size_t vertices = AddView(mesh.vertices.data(), mesh.vertices.size() * sizeof(Vertex),
                                    kArrayBuffer, sizeof(Vertex));
    const size_t indices = AddView(mesh.indices.data(), mesh.indices.size() * sizeof(uint32_t),
                                   kElementArrayBuffer, 0);
    Json position =
        Accessor(vertices, offsetof(Vertex, position), kFloat, "VEC3", mesh.vertices.size());
    AddRange(mesh, position);
    Json color =
        Accessor(vertices, offsetof(Vertex, color), kUnsignedShort, "VEC4", mesh.vertices.size());
    color["normalized"] = true;
    const Json attributes = {
        {"POSITION", Add("accessors", position)},
        {"COLOR_0", Add("accessors", color)},
        {"_IRRADIANCE", Add("accessors", Accessor(vertices, offsetof(Vertex, irradiance_lx), kFloat,
                                                  "VEC3", mesh.vertices.size()))}};
    const size_t index_accessor =
        Add("accessors", Accessor(indices, 0, kUnsignedInt, "SCALAR", mesh.indices.size()));
    Json made = {{"primitives",
                  {{{"attributes", attributes}, {"indices", index_accessor}, {"material", 0}}}}};
    if (!name.empty()) made["name"] = name;
    return Add("meshes", std::move(made));
  }

  size_t Add(const char* list, Json item) {
    root_[list].push_back(std::move(item));
    return root_[list].size() - 1;
  }

  absl::StatusOr<std::string> Finish() {
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

 private:
  size_t AddView(const void* data, size_t size, int target, size_t stride) {
    Json view = {
        {"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", size}, {"target", target}};
    if (stride > 0) view["byteStride"] = stride;
    binary_.append(static_cast<const char*>(data), size);
    return Add("bufferViews", std::move(view));
  }

  static Json Accessor(size_t view, size_t offset, int component, const char* type, size_t count) {
    return {{"bufferView", view},
            {"byteOffset", offset},
            {"componentType", component},
            {"type", type},
            {"count", count}};
  }

  // glTF demands the range of positions, equal to the stored float32 values.
  static void AddRange(const NodeMesh& mesh, Json& accessor) {
    std::array<float, 3> low = mesh.vertices[0].position, high = low;
    for (const Vertex& vertex : mesh.vertices) {
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], vertex.position[axis]);
        high[axis] = std::max(high[axis], vertex.position[axis]);
      }
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }

  Json root_;
  std::string binary_;
};

void AddCamera(const View& view, const PatchSet& patches, GlbWriter& writer) {
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
  writer.AddNode(
      {{"name", "view"},
       {"camera", writer.Add("cameras", std::move(camera))},
       {"matrix",
        {r.x, r.y, r.z, 0, u.x, u.y, u.z, 0, back.x, back.y, back.z, 0, eye.x, eye.y, eye.z, 1}}});
}

}  // namespace

absl::StatusOr<std::string> EncodeGlb(const PatchSet& patches,
                                      const CornerValues& corner_irradiance_lx,
                                      const Exposure& exposure, const View& view) {
  GlbWriter writer;
  for (const auto& [node, mesh] : MakeMeshes(patches, corner_irradiance_lx, exposure)) {
    const size_t named = static_cast<size_t>(node);
    const std::string name = named < patches.node_names.size() ? patches.node_names[named] : "";
    Json made = {{"mesh", writer.AddMesh(name, mesh)}, {"extras", {{"source_node", node}}}};
    if (!name.empty()) made["name"] = name;
    if (patches.origin != Vec3{}) {
      made["translation"] = {patches.origin.x, patches.origin.y, patches.origin.z};
    }
    writer.AddNode(std::move(made));
  }
  AddCamera(view, patches, writer);
  writer.root()["asset"]["extras"] = {
      {"exposure_per_lm_per_m2", exposure.per_lm_per_m2},
      {"color_0", "radiosity times exposure, highlights over .8 rolled off"},
      {"irradiance_unit", "lx"}};
  return writer.Finish();
}

}  // namespace lambert

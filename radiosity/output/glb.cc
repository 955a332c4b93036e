#include "radiosity/output/glb.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

#include "radiosity/output/float_value.h"
#include "radiosity/output/glb_writer.h"
#include "radiosity/output/texture_light.h"

namespace lambert {
namespace {

using Json = GlbWriter::Json;
using CornerValues = std::vector<std::array<Rgb, 3>>;

// One vertex of the file; interleaved.
struct Vertex {
  std::array<float, 3> position;
  std::array<float, 3> irradiance_lx;
  std::array<uint16_t, 4> color;  // red, green, blue, alpha; normalised
  std::array<float, 2> uv;        // zeros where there is no texture
  bool operator==(const Vertex&) const = default;
};
static_assert(sizeof(Vertex) == 40);

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

// Triangles of one node and one material, with equal vertices stored once.
struct Part {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
  std::unordered_map<Vertex, uint32_t, VertexHash> known;

  void Add(const Vertex& vertex) {
    const auto [found, is_new] = known.try_emplace(vertex, static_cast<uint32_t>(vertices.size()));
    if (is_new) vertices.push_back(vertex);
    indices.push_back(found->second);
  }
};

constexpr uint16_t kOpaque = 65535;

uint16_t Normalised(double value) {
  return static_cast<uint16_t>(std::lround(kOpaque * std::clamp(value, 0.0, 1.0)));
}

Vertex MakeVertex(const PatchSet& patches, const CornerValues& irradiance_lx,
                  const Exposure& exposure, const TextureLight& textures, PatchIndex i,
                  int corner) {
  Vertex vertex{};
  const Vec3 p = patches.corners[i][corner];
  vertex.position = {FloatValue(p.x), FloatValue(p.y), FloatValue(p.z)};
  const Rgb irradiance = irradiance_lx[i][corner];
  Rgb color;
  double alpha = 1;
  if (textures.MaterialOf(i) >= 0) {
    const TextureLight::Corner textured = textures.At(i, corner);
    color = textured.color;
    alpha = textured.alpha;
    vertex.uv = {FloatValue(textured.uv[0]), FloatValue(textured.uv[1])};
  } else {
    color = Develop(patches.exitance_lm_per_m2[i] + patches.reflectance[i] * irradiance, exposure);
  }
  for (int channel = 0; channel < 3; ++channel) {
    vertex.irradiance_lx[channel] = FloatValue(irradiance[channel]);
    vertex.color[channel] = Normalised(color[channel]);
  }
  vertex.color[3] = Normalised(alpha);
  return vertex;
}

// A primitive of the file.
Json AddPart(const Part& part, size_t material, bool textured, GlbWriter& writer) {
  const std::vector<Vertex>& vertices = part.vertices;
  const size_t count = vertices.size(), stride = sizeof(Vertex);
  const size_t view = writer.AddVertices(vertices.data(), count, stride);
  Json attributes;
  attributes["POSITION"] =
      writer.AddPositions(view, vertices.data(), count, stride, offsetof(Vertex, position));
  attributes["COLOR_0"] =
      writer.AddAttribute(view, offsetof(Vertex, color), GlbWriter::Type::kUnsignedShort, 4, count);
  attributes["_IRRADIANCE"] =
      writer.AddAttribute(view, offsetof(Vertex, irradiance_lx), GlbWriter::Type::kFloat, 3, count);
  if (textured) {
    attributes["TEXCOORD_0"] =
        writer.AddAttribute(view, offsetof(Vertex, uv), GlbWriter::Type::kFloat, 2, count);
  }
  return {{"attributes", std::move(attributes)},
          {"indices", writer.AddIndices(part.indices)},
          {"material", material}};
}

}  // namespace

absl::StatusOr<std::string> EncodeGlb(const PatchSet& patches,
                                      const CornerValues& corner_irradiance_lx,
                                      const Exposure& exposure, const View& view,
                                      const Scene* scene) {
  const TextureLight textures(patches, corner_irradiance_lx, exposure, scene);
  // By node, then by material of the scene (-1: vertex colours alone) and gain of its texture.
  using Look = std::pair<int, double>;
  std::map<int32_t, std::map<Look, Part>> nodes;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    Part& part = nodes[patches.source[i].node][{textures.MaterialOf(i), textures.GainOf(i)}];
    for (int corner = 0; corner < 3; ++corner) {
      part.Add(MakeVertex(patches, corner_irradiance_lx, exposure, textures, i, corner));
    }
  }
  GlbWriter writer;
  std::map<Look, size_t> materials;  // of the scene: of the file
  TextureLight::Copies copies;
  for (const auto& [node, parts] : nodes) {
    Json primitives = Json::array();
    for (const auto& [look, part] : parts) {
      const auto [material, gain] = look;
      const auto [known, is_new] = materials.try_emplace(look, 0);
      if (is_new) {
        known->second = writer.Add(
            "materials", material < 0 ? writer.UnlitMaterial("radiosity")
                                      : textures.MakeMaterial(material, gain, copies, writer));
      }
      primitives.push_back(AddPart(part, known->second, material >= 0, writer));
    }
    writer.AddMeshNode(patches, node,
                       writer.Add("meshes", {{"primitives", std::move(primitives)}}));
  }
  writer.AddCamera(view, patches);
  writer.root()["asset"]["extras"] = {
      {"exposure_per_lm_per_m2", exposure.per_lm_per_m2},
      {"exposure_ev100", Ev100Of(exposure.per_lm_per_m2)},
      {"tone_map", ToneMapName(exposure.tone_map)},
      {"color_0",
       "radiosity times exposure, through the tone map; what multiplies the base texture where "
       "there is one"},
      {"irradiance_unit", "lx"}};
  return writer.Finish();
}

}  // namespace lambert

#include "radiosity/output/lightmap_glb.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "radiosity/output/float_value.h"
#include "radiosity/output/glb_writer.h"

namespace lambert {
namespace {

using Json = GlbWriter::Json;

struct Vertex {
  std::array<float, 3> position;
  std::array<float, 2> uv;
};
static_assert(sizeof(Vertex) == 20);

constexpr int kLinear = 9729, kLinearMipmapLinear = 9987, kClampToEdge = 33071;  // of a sampler

Json AddPart(const AtlasPart& part, GlbWriter& writer) {
  std::vector<Vertex> vertices;
  for (size_t i = 0; i < part.source.size(); ++i) {
    const Vec3 p = part.position_m[i];
    vertices.push_back({{FloatValue(p.x), FloatValue(p.y), FloatValue(p.z)}, part.uv[i]});
  }
  std::vector<uint32_t> indices;
  for (const auto& triangle : part.triangles) {
    indices.insert(indices.end(), triangle.begin(), triangle.end());
  }
  const size_t view = writer.AddVertices(vertices.data(), vertices.size(), sizeof(Vertex));
  const size_t uv =
      writer.AddAttribute(view, offsetof(Vertex, uv), GlbWriter::Type::kFloat, 2, vertices.size());
  return {{"attributes",
           {{"POSITION", writer.AddPositions(view, vertices.data(), vertices.size(), sizeof(Vertex),
                                             offsetof(Vertex, position))},
            {"TEXCOORD_0", uv},  // glTF allows no gap in their numbers
            {"TEXCOORD_1", uv}}},
          {"indices", writer.AddIndices(indices)},
          {"material", part.page}};
}

}  // namespace

absl::StatusOr<std::string> EncodeLightmappedGlb(const Scene& scene, const PatchSet& patches,
                                                 const Atlas& atlas,
                                                 const std::vector<AtlasPart>& parts,
                                                 const std::vector<std::string>& pngs,
                                                 const Exposure& exposure, const View& view) {
  GlbWriter writer;
  for (size_t page = 0; page < pngs.size(); ++page) {
    const size_t texture = writer.AddTexture(pngs[page], "image/png",
                                             {{"magFilter", kLinear},
                                              {"minFilter", kLinearMipmapLinear},
                                              {"wrapS", kClampToEdge},
                                              {"wrapT", kClampToEdge}});
    Json material = writer.UnlitMaterial(absl::StrCat("lightmap page ", page));
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}, {"texCoord", 1}};
    writer.Add("materials", std::move(material));
  }
  std::map<int32_t, Json> primitives;  // by instance
  for (const AtlasPart& part : parts) {
    primitives[atlas.placed.surfaces[part.surface].instance].push_back(AddPart(part, writer));
  }
  for (auto& [instance, list] : primitives) {
    writer.AddMeshNode(patches, scene.instances[instance].node,
                       writer.Add("meshes", {{"primitives", std::move(list)}}));
  }
  writer.AddCamera(view, patches);
  writer.root()["asset"]["extras"] = {
      {"exposure_per_lm_per_m2", exposure.per_lm_per_m2},
      {"base_color", "radiosity times exposure, through the tone map"}};
  return writer.Finish();
}

}  // namespace lambert

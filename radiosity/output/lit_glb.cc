#include "radiosity/output/lit_glb.h"

#include <map>
#include <numbers>
#include <utility>

#include "absl/strings/str_cat.h"
#include "radiosity/core/vec3.h"
#include "radiosity/output/atlas_nodes.h"
#include "radiosity/output/float_value.h"
#include "radiosity/output/source_materials.h"

namespace lambert {
namespace {

using Json = GlbWriter::Json;

// The page as a texture, in both ways: its index.
size_t AddPage(const LightmapImages& page, GlbWriter& writer) {
  const size_t texture = writer.AddTexture(page.png, "image/png", AtlasSampler());
  const size_t rgbe = writer.AddImage(page.rgbe, "image/vnd.radiance");
  writer.UseExtension("MOZ_texture_rgbe");
  writer.root()["textures"][texture]["extensions"]["MOZ_texture_rgbe"] = {{"source", rgbe}};
  return texture;
}

// Elements of an attribute of the primitive, by vertex of the part.
template <typename Element>
std::vector<Element> Picked(const std::vector<Element>& elements, const AtlasPart& part) {
  std::vector<Element> picked;
  picked.reserve(part.source.size());
  for (const uint32_t vertex : part.source) picked.push_back(elements[vertex]);
  return picked;
}

template <size_t N>
Vec3 Direction(const std::array<float, N>& v) {
  return {v[0], v[1], v[2]};
}

// Normals and tangents where the instance shows them, on the side of the part: the back's frame is
// that of the front turned round.
void AddShading(const Primitive& primitive, const AtlasPart& part, const Transform& world,
                GlbWriter& writer, Json& attributes) {
  if (primitive.normals.empty()) return;
  const double mirror = world.Determinant() < 0 ? -1 : 1, side = part.is_back ? -1 : 1;
  const Transform cofactors = {
      Cross(world.y, world.z), Cross(world.z, world.x), Cross(world.x, world.y), {}};
  std::vector<std::array<float, 3>> normals = Picked(primitive.normals, part);
  for (std::array<float, 3>& normal : normals) {
    normal = ToFloats(Normalized(cofactors.Vector(Direction(normal))) * (mirror * side));
  }
  attributes["NORMAL"] = writer.AddFloats(normals);
  if (primitive.tangents.empty()) return;
  std::vector<std::array<float, 4>> tangents = Picked(primitive.tangents, part);
  for (std::array<float, 4>& tangent : tangents) {
    const std::array<float, 3> t = ToFloats(Normalized(world.Vector(Direction(tangent))) * side);
    tangent = {t[0], t[1], t[2], static_cast<float>(tangent[3] * mirror * side)};
  }
  attributes["TANGENT"] = writer.AddFloats(tangents);
}

// TEXCOORD_1 is the lightmap's; those of the file are 0, 2, 3, ... glTF allows no gap, so it also
// stands where the file has none.
void AddTextureCoordinates(const Primitive& primitive, const AtlasPart& part, GlbWriter& writer,
                           Json& attributes) {
  const size_t lightmap = writer.AddFloats(part.uv);
  attributes["TEXCOORD_0"] = attributes["TEXCOORD_1"] = lightmap;
  const int sets = primitive.uv.empty() ? 0 : primitive.uv.rbegin()->first + 1;
  for (int set = 0; set < sets; ++set) {
    const auto found = primitive.uv.find(set);
    size_t accessor = lightmap;
    if (found != primitive.uv.end()) {
      std::vector<std::array<float, 2>> uv = Picked(found->second, part);
      for (std::array<float, 2>& at : uv) at = {FloatValue(at[0]), FloatValue(at[1])};
      accessor = writer.AddFloats(uv);
    }
    attributes[absl::StrCat("TEXCOORD_", set == 0 ? 0 : set + 1)] = accessor;
  }
}

// The materials of the new file: one for each of the source on each page.
class LitMaterials {
 public:
  LitMaterials(const Appearance& appearance, const std::vector<LightmapImages>& pages,
               GlbWriter& writer)
      : source_(appearance, writer), pages_(pages), writer_(writer) {
    for (const LightmapImages& page : pages) textures_.push_back(AddPage(page, writer));
    writer.UseExtension("MOZ_lightmap");
  }

  size_t Find(int material, int32_t page) {
    const auto [known, is_new] = known_.try_emplace({material, page}, 0);
    if (!is_new) return known->second;
    Json made = source_.Make(material);
    made["doubleSided"] = false;  // both sides are there
    made["extensions"]["MOZ_lightmap"] = {
        {"index", textures_[page]}, {"texCoord", 1}, {"intensity", pages_[page].intensity}};
    return known->second = writer_.Add("materials", std::move(made));
  }

 private:
  SourceMaterials source_;
  const std::vector<LightmapImages>& pages_;
  GlbWriter& writer_;
  std::vector<size_t> textures_;                     // by page
  std::map<std::pair<int, int32_t>, size_t> known_;  // by material of the source and page
};

}  // namespace

absl::StatusOr<std::string> EncodeLitGlb(const Scene& scene, const PatchSet& patches,
                                         const Atlas& atlas, const std::vector<AtlasPart>& parts,
                                         const std::vector<LightmapImages>& pages,
                                         const Exposure& exposure, const View& view) {
  GlbWriter writer;
  LitMaterials materials(*scene.appearance, pages, writer);
  const auto make_primitive = [&](const AtlasPart& part) {
    const PlacedSurface& surface = atlas.placed.surfaces[part.surface];
    const Primitive& primitive = PrimitiveOf(scene, surface);
    Json attributes;
    AddTextureCoordinates(primitive, part, writer, attributes);
    AddShading(primitive, part, scene.instances[surface.instance].world, writer, attributes);
    if (!primitive.colors.empty()) {
      attributes["COLOR_0"] = writer.AddFloats(Picked(primitive.colors, part));
    }
    return AtlasPrimitive(part, std::move(attributes),
                          materials.Find(primitive.material, part.page), writer);
  };
  AddAtlasNodes(scene, patches, atlas, parts, view, make_primitive, writer);
  writer.root()["asset"]["extras"] = {
      {"lightmap", "irradiance over the intensity of MOZ_lightmap"},
      {"exposure_per_nit", std::numbers::pi * exposure.per_lm_per_m2},
      {"tone_map", ToneMapName(exposure.tone_map)}};
  return writer.Finish();
}

}  // namespace lambert

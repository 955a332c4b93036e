#include "radiosity/output/lightmap_glb.h"

#include <map>
#include <utility>

#include "absl/strings/str_cat.h"
#include "radiosity/output/atlas_nodes.h"

namespace lambert {

absl::StatusOr<std::string> EncodeLightmappedGlb(const Scene& scene, const PatchSet& patches,
                                                 const Atlas& atlas,
                                                 const std::vector<AtlasPart>& parts,
                                                 const std::vector<std::string>& pngs,
                                                 const Exposure& exposure, const View& view) {
  using Json = GlbWriter::Json;
  GlbWriter writer;
  std::vector<size_t> textures;
  for (size_t page = 0; page < pngs.size(); ++page) {
    textures.push_back(writer.AddTexture(pngs[page], "image/png", AtlasSampler()));
  }
  // By page and whether there is a mask: the material, once there is a part of it.
  std::map<std::pair<int32_t, bool>, size_t> materials;
  const auto material_of = [&](const AtlasPart& part) {
    const bool masked = IsMasked(scene, atlas, part);
    const auto [found, is_new] = materials.try_emplace({part.page, masked});
    if (!is_new) return found->second;
    Json material =
        writer.UnlitMaterial(absl::StrCat("lightmap page ", part.page, masked ? ", cut out" : ""));
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", textures[part.page]},
                                                            {"texCoord", 1}};
    if (masked) material["alphaMode"] = "MASK";
    return found->second = writer.Add("materials", std::move(material));
  };
  const auto make_primitive = [&](const AtlasPart& part) {
    const size_t uv = writer.AddFloats(part.uv);
    // glTF allows no gap in the numbers of texture coordinates.
    return AtlasPrimitive(part, {{"TEXCOORD_0", uv}, {"TEXCOORD_1", uv}}, material_of(part),
                          writer);
  };
  AddAtlasNodes(scene, patches, atlas, parts, view, make_primitive, writer);
  writer.root()["asset"]["extras"] = {
      {"exposure_per_lm_per_m2", exposure.per_lm_per_m2},
      {"base_color", "radiosity times exposure, through the tone map"}};
  return writer.Finish();
}

}  // namespace lambert

#include "radiosity/output/lightmap_glb.h"

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
  for (size_t page = 0; page < pngs.size(); ++page) {
    const size_t texture = writer.AddTexture(pngs[page], "image/png", AtlasSampler());
    Json material = writer.UnlitMaterial(absl::StrCat("lightmap page ", page));
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}, {"texCoord", 1}};
    writer.Add("materials", std::move(material));
  }
  const auto make_primitive = [&writer](const AtlasPart& part) {
    const size_t uv = writer.AddFloats(part.uv);
    // glTF allows no gap in the numbers of texture coordinates.
    return AtlasPrimitive(part, {{"TEXCOORD_0", uv}, {"TEXCOORD_1", uv}},
                          static_cast<size_t>(part.page), writer);
  };
  AddAtlasNodes(scene, patches, atlas, parts, view, make_primitive, writer);
  writer.root()["asset"]["extras"] = {
      {"exposure_per_lm_per_m2", exposure.per_lm_per_m2},
      {"base_color", "radiosity times exposure, through the tone map"}};
  return writer.Finish();
}

}  // namespace lambert

#include "radiosity/output/lightmap_files.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/str_cat.h"
#include "radiosity/lightmap/atlas_part.h"
#include "radiosity/lightmap/lightmap.h"
#include "radiosity/output/exr.h"
#include "radiosity/output/float_value.h"
#include "radiosity/output/lightmap_glb.h"
#include "radiosity/output/lightmap_image.h"
#include "radiosity/output/lit_glb.h"
#include "radiosity/output/output_file.h"
#include "radiosity/output/png.h"
#include "radiosity/patch/place.h"

namespace lambert {
namespace {

using Json = nlohmann::ordered_json;

// Where patches are left out the mask ends, but for what viewers mix in at a chart's border.
constexpr int kMaskRings = 1;

// The page as the picture shows it: exitance and reflected light, developed. Alpha is the share of
// each texel that masks leave where the page is `masked`.
std::string DrawPage(const TexelReader& reader, const TexelPage& page,
                     const TexelValues& irradiance_lx, const Exposure& exposure, bool masked) {
  TexelValues display(page.texels.size());
  std::vector<std::array<float, 1>> coverage(page.texels.size());
  for (size_t i = 0; i < display.size(); ++i) {
    if (page.texels[i].patch == kNoPatch) continue;
    const TexelSurface surface = reader.At(page, i);
    const auto& [r, g, b] = irradiance_lx[i];
    const Rgb seen =
        Develop(surface.exitance_lm_per_m2 + surface.reflectance * Rgb{r, g, b}, exposure);
    for (int channel = 0; channel < 3; ++channel) {
      display[i][channel] = static_cast<float>(seen[channel]);
    }
    coverage[i] = {static_cast<float>(surface.coverage)};
  }
  Dilate(page, display);
  Dilate(page, coverage, kMaskRings);
  std::vector<Rgb> pixels;
  pixels.reserve(display.size());
  for (const auto& [r, g, b] : display) pixels.push_back({r, g, b});
  std::vector<float> alpha;
  if (masked) {
    for (const auto& [share] : coverage) alpha.push_back(share);
  }
  return EncodePng(page.width, page.height, pixels, alpha);
}

// The light in every texel of a page, gathered at its point [lx].
absl::StatusOr<TexelValues> GatherTexels(const TexelPage& page, const PatchSet& patches,
                                         const std::vector<std::array<Vec3, 3>>& corner_normals,
                                         const GatherFunction& gather) {
  GatherPoints points;
  for (const Texel& texel : page.texels) {
    if (texel.patch == kNoPatch) continue;
    const auto& [n0, n1, n2] = corner_normals[texel.patch];
    const double u = texel.u, v = texel.v;
    points.Add(TexelPoint(patches, texel), Normalized(n0 * (1 - u - v) + n1 * u + n2 * v));
  }
  const absl::StatusOr<Gathered> gathered = gather(points);
  if (!gathered.ok()) return gathered.status();
  TexelValues values(page.texels.size());
  size_t next = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    if (page.texels[i].patch == kNoPatch) continue;
    const Rgb light = gathered->irradiance_lx[next++];
    values[i] = {FloatValue(light.r), FloatValue(light.g), FloatValue(light.b)};
  }
  return values;
}

std::string IrradianceFile(const std::string& stem, size_t page) {
  return page == 0 ? stem + ".irradiance.exr"
                   : absl::StrCat(stem, ".irradiance-", page + 1, ".exr");
}

Json PrimitiveJson(const Scene& scene, const Atlas& atlas, const AtlasPart& part) {
  const PlacedSurface& surface = atlas.placed.surfaces[part.surface];
  const Instance& instance = scene.instances[surface.instance];
  const int32_t kept = atlas.kept_uv[part.surface];
  return {{"instance", surface.instance},
          {"node", instance.node},
          {"mesh", FileMeshOf(scene, instance)},
          {"primitive", surface.primitive},
          {"side", part.is_back ? "back" : "front"},
          {"page", part.page},
          {"triangles", part.triangles.size()},
          {"charts", kept < 0 ? Json("own") : Json(absl::StrCat("TEXCOORD_", kept))}};
}

Json Manifest(const std::string& name, const RunRecord& record, const std::vector<AtlasPart>& parts,
              const std::vector<LightmapImages>& images, const Exposure& exposure) {
  const Atlas& atlas = *record.atlas;
  Json json;
  json["quantity"] = "E";
  json["unit"] = UnitNamesOf(record.patch_options.emission_unit).irradiance;
  json["about"] =
      "irradiance E of each texel; a lightMap of three.js takes E as it is, Blender's bakes hold "
      "E / pi";
  json["exposure_per_lm_per_m2"] = exposure.per_lm_per_m2;
  json["texels_per_meter"] = atlas.texels_per_meter;
  json["padding_texels"] = kPadding;
  json["texture_coordinates"] = "TEXCOORD_1, (0, 0) at the upper left corner of the page";
  json["lightmapped"] = name + ".lightmapped.glb";
  json["lit"] = name + ".lit.glb";
  json["pages"] = Json::array();
  for (size_t page = 0; page < atlas.pages.size(); ++page) {
    json["pages"].push_back({{"file", IrradianceFile(name, page)},
                             {"width", atlas.pages[page].width},
                             {"height", atlas.pages[page].height},
                             {"intensity", images[page].intensity}});
  }
  json["primitives"] = Json::array();
  for (const AtlasPart& part : parts) {
    json["primitives"].push_back(PrimitiveJson(*record.scene, atlas, part));
  }
  return json;
}

}  // namespace

absl::Status WriteLightmap(const std::string& stem, const RunRecord& record,
                           const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
                           const Exposure& exposure, const View& view,
                           const std::vector<std::array<Vec3, 3>>& corner_normals,
                           const GatherFunction& gather) {
  const Scene& scene = *record.scene;
  const PatchSet& patches = *record.patches;
  const Atlas& atlas = *record.atlas;
  const absl::StatusOr<TexelReader> reader = TexelReader::Create(scene, patches, atlas);
  if (!reader.ok()) return reader.status();
  const std::vector<AtlasPart> parts = PartsOf(atlas, SidesWithPatches(scene, patches, atlas));
  std::vector<bool> masked(atlas.pages.size());
  for (const AtlasPart& part : parts) {
    masked[part.page] = masked[part.page] || IsMasked(scene, atlas, part);
  }
  std::vector<std::string> pngs;
  std::vector<LightmapImages> images;
  const std::vector<TexelPage> pages = FindTexels(scene, patches, atlas);
  for (size_t page = 0; page < pages.size(); ++page) {
    absl::StatusOr<TexelValues> light = TexelIrradiance(pages[page], corner_irradiance_lx);
    if (gather != nullptr) light = GatherTexels(pages[page], patches, corner_normals, gather);
    if (!light.ok()) return light.status();
    pngs.push_back(DrawPage(*reader, pages[page], *light, exposure, masked[page]));
    Dilate(pages[page], *light);
    const absl::StatusOr<std::string> exr = EncodeIrradianceExr(pages[page], *light);
    if (!exr.ok()) return exr.status();
    absl::Status status = WriteOutputFile(IrradianceFile(stem, page), *exr);
    if (!status.ok()) return status;
    images.push_back(EncodeLightmapImages(pages[page], *light));
  }
  absl::Status status =
      WriteIfOk(stem + ".lightmapped.glb",
                EncodeLightmappedGlb(scene, patches, atlas, parts, pngs, exposure, view));
  if (!status.ok()) return status;
  status = WriteIfOk(stem + ".lit.glb",
                     EncodeLitGlb(scene, patches, atlas, parts, images, exposure, view));
  if (!status.ok()) return status;
  const std::string name = std::filesystem::path(stem).filename().string();
  return WriteOutputFile(stem + ".lightmap.json",
                         Manifest(name, record, parts, images, exposure)
                                 .dump(2, ' ', false, Json::error_handler_t::replace) +
                             "\n");
}

}  // namespace lambert

#include "radiosity/scene/gltf_material.h"

#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_extensions.h"
#include "radiosity/scene/gltf_texture.h"

namespace lambert {
namespace {

Rgb ToRgb(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

TextureInfo FromGltf(const tinygltf::TextureInfo& info) {
  return {info.index, info.texCoord, info.extensions_json_string};
}

// What a material reflects diffusely, whatever model it follows.
struct Diffuse {
  std::vector<double> factor;  // RGBA
  TextureInfo texture;
};

absl::StatusOr<Diffuse> ReadDiffuse(const tinygltf::Material& gltf, const std::string& where,
                                    UnreadFeatures* unread) {
  const nlohmann::json glossy =
      FindExtension(gltf.extensions_json_string, "KHR_materials_pbrSpecularGlossiness");
  if (glossy.is_object()) {
    absl::StatusOr<std::vector<double>> factor =
        NumbersOf(glossy, "diffuseFactor", {1, 1, 1, 1}, where);
    if (!factor.ok()) return factor.status();
    return Diffuse{*std::move(factor), TextureInfoOf(glossy, "diffuseTexture")};
  }
  const tinygltf::PbrMetallicRoughness& pbr = gltf.pbrMetallicRoughness;
  if (pbr.metallicFactor > 0) {
    unread->Add("metalness", "material", "base colour taken as diffuse reflectance");
  }
  return Diffuse{pbr.baseColorFactor, FromGltf(pbr.baseColorTexture)};
}

// The share of the light that is not reflected but let through.
absl::StatusOr<double> ReadTransmission(const tinygltf::Material& gltf, const std::string& where,
                                        UnreadFeatures* unread) {
  double reflected = 1;
  for (const auto& [name, field] :
       {std::pair{"KHR_materials_transmission", "transmissionFactor"},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"}}) {
    const absl::StatusOr<double> factor =
        ExtensionNumber(gltf.extensions_json_string, name, field, 0, where);
    if (!factor.ok()) return factor.status();
    if (!(*factor >= 0 && *factor <= 1)) {
      return SceneError(where, absl::StrCat(field, " is not from 0 to 1"), "export the file again");
    }
    if (*factor > 0) unread->Add(name, "material", "what would pass through is absorbed");
    reflected *= 1 - *factor;
  }
  return 1 - reflected;
}

void CountUnread(const tinygltf::Material& gltf, UnreadFeatures* unread) {
  if (gltf.extensions.count("KHR_materials_unlit") > 0) {
    unread->Add("KHR_materials_unlit", "material", "base colour taken as diffuse reflectance");
  }
}

absl::Status ReadReflectance(const tinygltf::Material& gltf, const std::string& where,
                             TextureLoader* textures, UnreadFeatures* unread, Material* material) {
  const absl::StatusOr<Diffuse> diffuse = ReadDiffuse(gltf, where, unread);
  if (!diffuse.ok()) return diffuse.status();
  const absl::StatusOr<double> transmission = ReadTransmission(gltf, where, unread);
  if (!transmission.ok()) return transmission.status();
  material->reflectance = ToRgb(diffuse->factor) * (1 - *transmission);
  if (gltf.alphaMode == "MASK") material->alpha_cutoff = gltf.alphaCutoff;
  material->alpha = diffuse->factor[3];
  if (material->reflectance == Rgb{} && material->alpha_cutoff <= 0) return absl::OkStatus();
  absl::StatusOr<TextureUse> use = ReadTexture(diffuse->texture, where, textures, unread);
  if (use.ok()) material->reflectance_texture = *use;
  return use.status();
}

absl::Status ReadLuminance(const tinygltf::Material& gltf, const std::string& where,
                           TextureLoader* textures, UnreadFeatures* unread, Material* material) {
  const absl::StatusOr<double> strength = ExtensionNumber(
      gltf.extensions_json_string, "KHR_materials_emissive_strength", "emissiveStrength", 1, where);
  if (!strength.ok()) return strength.status();
  material->luminance = ToRgb(gltf.emissiveFactor) * *strength;
  if (material->luminance == Rgb{}) return absl::OkStatus();
  absl::StatusOr<TextureUse> use =
      ReadTexture(FromGltf(gltf.emissiveTexture), where, textures, unread);
  if (use.ok()) material->luminance_texture = *use;
  return use.status();
}

absl::StatusOr<Material> ReadMaterial(const tinygltf::Material& gltf, const std::string& where,
                                      TextureLoader* textures, UnreadFeatures* unread) {
  Material material;
  absl::Status status = ReadReflectance(gltf, where, textures, unread, &material);
  if (status.ok()) status = ReadLuminance(gltf, where, textures, unread, &material);
  if (!status.ok()) return status;
  material.two_sided = gltf.doubleSided;
  material.blend = gltf.alphaMode == "BLEND";
  CountUnread(gltf, unread);
  return material;
}

}  // namespace

absl::StatusOr<std::vector<Material>> ReadMaterials(const tinygltf::Model& model,
                                                    const std::vector<bool>& used,
                                                    TextureLoader* textures,
                                                    UnreadFeatures* unread) {
  std::vector<Material> materials(model.materials.size());
  for (size_t i = 0; i < materials.size(); ++i) {
    if (used[i]) {
      absl::StatusOr<Material> material =
          ReadMaterial(model.materials[i], absl::StrCat("material ", i), textures, unread);
      if (!material.ok()) return material.status();
      materials[i] = *std::move(material);
    }
    materials[i].name = model.materials[i].name;
  }
  return materials;
}

}  // namespace lambert

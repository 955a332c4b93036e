#include "radiosity/scene/gltf_material.h"

#include "absl/strings/str_cat.h"
#include "radiosity/scene/gltf_extensions.h"

namespace lambert {
namespace {

// Lambert reads TEXCOORD_0 and TEXCOORD_1.
constexpr int kUvSets = 2;

Rgb ToRgb(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

struct TextureUse {
  int texture = -1, uv = 0;
};

// The texture that `info` (a tinygltf texture info) names, if anything of it shows.
template <typename Info>
absl::StatusOr<TextureUse> ReadTexture(const Info& info, bool shows, const char* what,
                                       TextureLoader* textures, UnreadFeatures* unread) {
  if (info.index < 0 || !shows) return TextureUse{};
  if (info.extensions.count("KHR_texture_transform") > 0) {
    unread->Add("KHR_texture_transform", "texture", "taken without offset, rotation and scale");
  }
  if (info.texCoord < 0 || info.texCoord >= kUvSets) {
    unread->Add(absl::StrCat(what, " with TEXCOORD_2 or higher"), "texture", "left out");
    return TextureUse{};
  }
  absl::StatusOr<int> texture = textures->Load(info.index);
  if (!texture.ok()) return texture.status();
  if (*texture < 0) unread->Add("image from an extension", "texture", "left out");
  return TextureUse{*texture, info.texCoord};
}

void CountUnread(const tinygltf::Material& gltf, UnreadFeatures* unread) {
  if (gltf.alphaMode == "BLEND") unread->Add("alpha mode BLEND", "material", "taken as opaque");
  if (gltf.pbrMetallicRoughness.metallicFactor > 0) {
    unread->Add("metalness", "material", "base colour taken as diffuse reflectance");
  }
  if (gltf.extensions.count("KHR_materials_unlit") > 0) {
    unread->Add("KHR_materials_unlit", "material", "base colour taken as diffuse reflectance");
  }
}

absl::StatusOr<Material> ReadMaterial(const tinygltf::Material& gltf, const std::string& where,
                                      TextureLoader* textures, UnreadFeatures* unread) {
  Material material;
  const tinygltf::PbrMetallicRoughness& pbr = gltf.pbrMetallicRoughness;
  material.reflectance = ToRgb(pbr.baseColorFactor);
  if (gltf.alphaMode == "MASK") material.alpha_cutoff = gltf.alphaCutoff;
  material.alpha = pbr.baseColorFactor[3];
  absl::StatusOr<TextureUse> use =
      ReadTexture(pbr.baseColorTexture, material.reflectance != Rgb{} || material.alpha_cutoff > 0,
                  "base colour texture", textures, unread);
  if (!use.ok()) return use.status();
  material.reflectance_texture = use->texture;
  material.reflectance_uv = use->uv;

  absl::StatusOr<double> strength = ExtensionNumber(
      gltf.extensions_json_string, "KHR_materials_emissive_strength", "emissiveStrength", 1, where);
  if (!strength.ok()) return strength.status();
  material.luminance = ToRgb(gltf.emissiveFactor) * *strength;
  use = ReadTexture(gltf.emissiveTexture, material.luminance != Rgb{}, "emissive texture", textures,
                    unread);
  if (!use.ok()) return use.status();
  material.luminance_texture = use->texture;
  material.luminance_uv = use->uv;
  material.two_sided = gltf.doubleSided;
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

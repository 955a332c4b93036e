#include "radiosity/output/source_materials.h"

#include <utility>

#include "absl/strings/match.h"

namespace lambert {

using Json = GlbWriter::Json;

namespace {

// Element `index` of a list of the file; null where there is none.
Json ElementOf(const Json& source, const char* list, const Json& index) {
  const auto found = source.find(list);
  if (found == source.end() || !index.is_number_unsigned() || index >= found->size()) {
    return nullptr;
  }
  return (*found)[index.get<size_t>()];
}

}  // namespace

SourceMaterials::SourceMaterials(const Appearance& appearance, GlbWriter& writer)
    : appearance_(appearance),
      writer_(writer),
      source_(Json::parse(appearance.json, nullptr, false)) {}

Json SourceMaterials::Make(int index) {
  Json material = ElementOf(source_, "materials", index < 0 ? Json() : Json(size_t(index)));
  if (!material.is_object()) {
    return {{"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}};
  }
  KeepExtensions(material, true);
  Adapt(material);
  return material;
}

// Leaves out what cannot be kept, and names the rest.
void SourceMaterials::KeepExtensions(Json& object, bool standard_only) {
  if (!object.contains("extensions")) return;
  Json kept = Json::object();
  for (auto& [name, content] : object["extensions"].items()) {
    const bool standard = absl::StartsWith(name, "KHR_") || absl::StartsWith(name, "EXT_");
    if (standard_only && !standard) continue;
    writer_.UseExtension(name);
    kept[name] = std::move(content);
  }
  object["extensions"] = std::move(kept);
  if (object["extensions"].empty()) object.erase("extensions");
}

// Every object that glTF and its extensions call somethingTexture names a texture.
void SourceMaterials::Adapt(Json& value) {
  if (!value.is_structured()) return;
  for (auto& [name, part] : value.items()) {
    if (name == "extras") continue;
    if (name == "texCoord" && part.is_number_unsigned() && part > 0) {
      part = part.get<size_t>() + 1;
      continue;
    }
    Adapt(part);
    if (!absl::EndsWith(name, "Texture") || !part.is_object() || !part.contains("index")) continue;
    part["index"] = AddTexture(part["index"]);
    KeepExtensions(part, true);
  }
}

Json SourceMaterials::AddTexture(const Json& index) {
  Json texture = ElementOf(source_, "textures", index);
  if (!texture.is_object()) return index;
  const auto [known, is_new] = textures_.try_emplace(index.get<size_t>());
  if (!is_new) return known->second;
  if (texture.contains("sampler")) {
    const Json sampler = ElementOf(source_, "samplers", texture["sampler"]);
    const auto [found, first] = samplers_.try_emplace(texture["sampler"].get<size_t>());
    if (first) found->second = writer_.Add("samplers", sampler);
    texture["sampler"] = found->second;
  }
  KeepExtensions(texture, false);
  const auto move_source = [this](Json& owner) {
    if (!owner.contains("source")) return;
    owner["source"] = AddImage(owner["source"]);
    if (owner["source"].is_null()) owner.erase("source");
  };
  move_source(texture);
  if (texture.contains("extensions")) {
    for (Json& extension : texture["extensions"]) move_source(extension);
  }
  return known->second = writer_.Add("textures", std::move(texture));
}

// Null for an image without bytes.
Json SourceMaterials::AddImage(const Json& index) {
  Json image = ElementOf(source_, "images", index);
  if (!image.is_object() || appearance_.images[index.get<size_t>()].empty()) return nullptr;
  const auto [known, is_new] = images_.try_emplace(index.get<size_t>());
  if (!is_new) return known->second;
  image["bufferView"] = writer_.AddBytes(appearance_.images[index.get<size_t>()]);
  return known->second = writer_.Add("images", std::move(image));
}

}  // namespace lambert

#include "radiosity/scene/gltf_extensions.h"

#include <nlohmann/json.hpp>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_container.h"

namespace lambert {
namespace {

enum class Support {
  kRead,     // read whole
  kCounted,  // counted where it is used (materials, lights, nodes)
  kLeftOut,  // the scene is close to what was meant without it: named in a warning
};

struct KnownExtension {
  const char* name;
  Support support;
};

constexpr KnownExtension kKnown[] = {
    {"EXT_lights_ies", Support::kRead},
    {"EXT_mesh_gpu_instancing", Support::kRead},
    {"EXT_meshopt_compression", Support::kRead},
    {"EXT_texture_avif", Support::kCounted},
    {"EXT_texture_webp", Support::kCounted},
    {"KHR_draco_mesh_compression", Support::kRead},
    {"KHR_lights_punctual", Support::kRead},
    {"KHR_materials_anisotropy", Support::kLeftOut},
    {"KHR_materials_clearcoat", Support::kLeftOut},
    {"KHR_materials_diffuse_transmission", Support::kCounted},
    {"KHR_materials_dispersion", Support::kLeftOut},
    {"KHR_materials_emissive_strength", Support::kRead},
    {"KHR_materials_ior", Support::kLeftOut},
    {"KHR_materials_iridescence", Support::kLeftOut},
    {"KHR_materials_pbrSpecularGlossiness", Support::kRead},
    {"KHR_materials_sheen", Support::kLeftOut},
    {"KHR_materials_specular", Support::kLeftOut},
    {"KHR_materials_transmission", Support::kCounted},
    {"KHR_materials_unlit", Support::kCounted},
    {"KHR_materials_variants", Support::kLeftOut},
    {"KHR_materials_volume", Support::kLeftOut},
    {"KHR_mesh_quantization", Support::kRead},
    {"KHR_texture_basisu", Support::kCounted},
    {"KHR_texture_transform", Support::kRead},
    {"MSFT_texture_dds", Support::kCounted},
};

const KnownExtension* FindKnown(const std::string& name) {
  for (const KnownExtension& known : kKnown) {
    if (name == known.name) return &known;
  }
  return nullptr;
}

// True for "2.0", "2.1", "2.0-draft"; false for "1.0", "3.0", "" and nonsense.
bool IsVersion2(const std::string& version) { return absl::StartsWith(version, "2."); }

}  // namespace

absl::Status CheckVersionAndExtensions(const tinygltf::Model& model, UnreadFeatures* unread) {
  const tinygltf::Asset& asset = model.asset;
  if (!IsVersion2(asset.version)) {
    return SceneError("asset",
                      absl::StrCat("its glTF version is \"", Printable(asset.version), "\""),
                      "convert the file to glTF 2.0");
  }
  // minVersion is the oldest reader that will do: Lambert is a reader of 2.0.
  if (!asset.minVersion.empty() && asset.minVersion != "2.0") {
    return SceneError("asset", absl::StrCat("it needs glTF ", Printable(asset.minVersion)),
                      "export the file as glTF 2.0");
  }
  for (const std::string& name : model.extensionsRequired) {
    if (FindKnown(name) == nullptr) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"EXTENSION_UNSUPPORTED", "extensionsRequired",
                        absl::StrCat("the file requires ", Printable(name), ", which is not read"),
                        "export it without this extension"});
    }
  }
  for (const std::string& name : model.extensionsUsed) {
    const KnownExtension* known = FindKnown(name);
    if (known == nullptr || known->support == Support::kLeftOut) {
      unread->Add("extension " + Printable(name), "file", "left out");
    }
  }
  return absl::OkStatus();
}

nlohmann::json FindExtension(const std::string& extensions_json, const std::string& name) {
  if (extensions_json.empty()) return nullptr;
  const nlohmann::json all = nlohmann::json::parse(extensions_json, nullptr, false);
  if (!all.is_object() || !all.contains(name) || !all[name].is_object()) return nullptr;
  return all[name];
}

absl::StatusOr<std::vector<double>> NumbersOf(const nlohmann::json& extension,
                                              const std::string& field, std::vector<double> absent,
                                              const std::string& where) {
  if (!extension.is_object() || !extension.contains(field)) return absent;
  const nlohmann::json& value = extension[field];
  const nlohmann::json list = value.is_array() ? value : nlohmann::json::array({value});
  bool numbers = list.size() == absent.size();
  for (const nlohmann::json& number : list) numbers = numbers && number.is_number();
  if (!numbers) {
    return SceneError(where, absl::StrCat(field, " is not ", absent.size(), " number(s)"),
                      "export the file again");
  }
  return list.get<std::vector<double>>();
}

absl::StatusOr<double> ExtensionNumber(const std::string& extensions_json, const std::string& name,
                                       const std::string& field, double absent,
                                       const std::string& where) {
  absl::StatusOr<std::vector<double>> read =
      NumbersOf(FindExtension(extensions_json, name), field, {absent}, where);
  if (!read.ok()) return read.status();
  return read->front();
}

}  // namespace lambert

#include "radiosity/scene/gltf_ies.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/escaping.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_container.h"
#include "radiosity/scene/gltf_extensions.h"
#include "radiosity/scene/light_files.h"

namespace lambert {
namespace {

constexpr char kName[] = "EXT_lights_ies";

absl::Status Bad(const std::string& where, const std::string& what) {
  return SceneError(where, absl::StrCat(what, " (", kName, ")"), "export the file again");
}

// A lamp of the file's list: {"uri": ...} or {"bufferView": ...}.
absl::StatusOr<LampProfile> ReadProfile(const tinygltf::Model& model, const nlohmann::json& entry,
                                        const Scene& scene, const std::string& where) {
  if (entry.is_object() && entry.contains("uri") && entry["uri"].is_string()) {
    const std::string uri = entry["uri"].get<std::string>();
    if (!absl::StartsWith(uri, "data:")) {
      const auto file = scene.lamps.find(DecodeUri(uri));
      if (file != scene.lamps.end()) return file->second;
      return Bad(where, absl::StrCat("there is no file \"", Printable(uri), "\" of a lamp (.ies)"));
    }
    const size_t comma = uri.find(";base64,");
    std::string bytes;
    if (comma == std::string::npos || !absl::Base64Unescape(uri.substr(comma + 8), &bytes)) {
      return Bad(where, "the data of its lamp are not in base64");
    }
    return ReadIes(where, bytes);
  }
  if (!entry.is_object() || !entry.contains("bufferView") ||
      !entry["bufferView"].is_number_integer()) {
    return Bad(where, "its lamp has neither a uri nor a bufferView");
  }
  const absl::StatusOr<ByteSpan> span = FindBufferView(model, entry["bufferView"].get<int>());
  if (!span.ok()) return span.status();
  return ReadIes(where, std::string(reinterpret_cast<const char*>(span->data), span->size));
}

std::vector<std::string> ListOf(const tinygltf::Model& model) {
  const nlohmann::json all = FindExtension(model.extensions_json_string, kName);
  std::vector<std::string> list;
  if (!all.is_object() || !all.contains("lights") || !all["lights"].is_array()) return list;
  const auto replace = nlohmann::json::error_handler_t::replace;
  for (const nlohmann::json& entry : all["lights"])
    list.push_back(entry.dump(-1, ' ', false, replace));
  return list;
}

}  // namespace

IesLamps::IesLamps(const tinygltf::Model& model, const Scene& scene)
    : model_(model), scene_(scene), list_(ListOf(model)) {}

absl::StatusOr<LampProfile> IesLamps::ProfileOf(double index, const std::string& where) {
  if (!(index >= 0) || index >= static_cast<double>(list_.size())) {
    return Bad(where, absl::StrCat("its lamp ", index, " does not exist"));
  }
  const auto at = static_cast<size_t>(index);
  if (const auto found = read_.find(at); found != read_.end()) return found->second;
  absl::StatusOr<LampProfile> profile =
      ReadProfile(model_, nlohmann::json::parse(list_[at]), scene_, where);
  if (profile.ok()) read_[at] = *profile;
  return profile;
}

absl::StatusOr<std::optional<Light>> IesLamps::At(int node, const std::optional<Transform>& axes,
                                                  const std::string& where) {
  const std::string& extensions = model_.nodes[node].extensions_json_string;
  const nlohmann::json own = FindExtension(extensions, kName);
  if (!own.is_object() || !axes) return std::nullopt;
  const absl::StatusOr<double> index = ExtensionNumber(extensions, kName, "light", -1, where);
  const absl::StatusOr<double> multiplier =
      ExtensionNumber(extensions, kName, "multiplier", 1, where);
  const absl::StatusOr<std::vector<double>> color = NumbersOf(own, "color", {1, 1, 1}, where);
  for (const absl::Status& status : {index.status(), multiplier.status(), color.status()}) {
    if (!status.ok()) return status;
  }
  absl::StatusOr<LampProfile> profile = ProfileOf(*index, where);
  if (!profile.ok()) return profile.status();
  Light light = LampAt(*profile, *axes);
  for (int c = 0; c < 3; ++c) light.strength[c] = *multiplier * std::clamp((*color)[c], 0.0, 1.0);
  return light;
}

}  // namespace lambert

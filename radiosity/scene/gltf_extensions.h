// Which glTF extensions Lambert knows, and values of theirs read from their JSON text.
#pragma once

#include <tiny_gltf.h>

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {

// Refuses a file that asks for a newer glTF than 2.x (SCENE_INVALID), or requires an extension that
// cannot be left out (EXTENSION_UNSUPPORTED, by name). Extensions that are used, change what is
// seen and are not read are added to `unread`.
absl::Status CheckVersionAndExtensions(const tinygltf::Model& model, UnreadFeatures* unread);

// Number `field` of extension `name` in `extensions_json` (an "extensions" object as text), or
// `absent` where there is none. SceneError naming `where` for a value that is not a number.
absl::StatusOr<double> ExtensionNumber(const std::string& extensions_json, const std::string& name,
                                       const std::string& field, double absent,
                                       const std::string& where);

// The object of extension `name` in `extensions_json`; null where there is none.
nlohmann::json FindExtension(const std::string& extensions_json, const std::string& name);

// The numbers `field` of an extension, or `absent` where there are none. SceneError naming `where`
// for anything but as many numbers as `absent` has.
absl::StatusOr<std::vector<double>> NumbersOf(const nlohmann::json& extension,
                                              const std::string& field, std::vector<double> absent,
                                              const std::string& where);

}  // namespace lambert

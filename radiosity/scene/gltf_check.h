// Whether a file's JSON is glTF 2.0, before anything is read of it.
#pragma once

#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "radiosity/core/warning.h"

namespace lambert {

// Checks types, ranges, lengths, indices, required properties and extensions (gltf_rules.h) and
// what holds between properties (gltf_relations.h), whatever the default scene shows of it; data
// are not looked at. SceneError names the first fault. Returns warnings of what is wrong, but clear
// all the same: JSON_BOM, JSON_DUPLICATE_KEY, EXTENSION_REQUIRED_NOT_USED. Files of another version
// than 2.x pass: they are refused by that. Requires: FindJsonText gave `text`, so that it is not
// nested deep.
absl::Status CheckGltf(absl::string_view text, std::vector<Warning>* warnings);

}  // namespace lambert

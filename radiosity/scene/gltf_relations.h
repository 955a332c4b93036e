// What glTF 2.0 says of properties together: rules that need more than one of them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "absl/status/status.h"

namespace lambert {

// Of one object of the kind `object` (gltf_rules.h) in the file `root`. SceneError at `where`.
// Requires: every property of `value`, and of the buffers of `root`, is as its rule says.
absl::Status CheckRelations(const std::string& object, const nlohmann::json& value,
                            const nlohmann::json& root, const std::string& where);

}  // namespace lambert

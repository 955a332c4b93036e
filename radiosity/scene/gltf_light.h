// Lights of a glTF file (KHR_lights_punctual).
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/core/transform.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// A light of `node` at `world`, with `axes` of its own (orthonormal), of which -z is where it
// shines. Light does not end at `range`. nullopt for a spot or directional light without axes.
// SceneError naming `where` for a type that is unknown and for cones that cannot be.
absl::StatusOr<std::optional<Light>> ReadLight(const tinygltf::Light& gltf, const Vec3& position,
                                               const std::optional<Transform>& axes,
                                               const std::string& where);

}  // namespace lambert

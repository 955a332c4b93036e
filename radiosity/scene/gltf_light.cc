#include "radiosity/scene/gltf_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_container.h"

namespace lambert {
namespace {

// The narrowest rim of a cone that KHR_lights_punctual takes, in cosines.
constexpr double kLeastRim = 0.001;

absl::Status SetCone(const tinygltf::SpotLight& spot, const std::string& where, Light* light) {
  const double inner_rad = spot.innerConeAngle, outer_rad = spot.outerConeAngle;
  if (!(inner_rad >= 0) || !(inner_rad <= outer_rad) || !(outer_rad > 0) ||
      !(outer_rad <= std::numbers::pi / 2 + 1e-6)) {
    return SceneError(
        where, absl::StrCat("its spot light has cones of ", inner_rad, " and ", outer_rad, " rad"),
        "give it 0 <= innerConeAngle < outerConeAngle <= pi / 2");
  }
  light->cos_outer = std::cos(outer_rad);
  light->cos_inner = light->cos_outer + std::max(kLeastRim, std::cos(inner_rad) - light->cos_outer);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::optional<Light>> ReadLight(const tinygltf::Light& gltf, const Vec3& position,
                                               const std::optional<Transform>& axes,
                                               const std::string& where) {
  Light light;
  light.position = position;
  Rgb color{1, 1, 1};
  if (gltf.color.size() == 3) color = {gltf.color[0], gltf.color[1], gltf.color[2]};
  light.strength = color * gltf.intensity;
  if (gltf.type == "point") return light;
  if (gltf.type != "spot" && gltf.type != "directional") {
    return SceneError(where, absl::StrCat("its light is of type \"", Printable(gltf.type), "\""),
                      "make it a point, spot or directional light");
  }
  if (!axes) return std::nullopt;
  light.x = axes->x;
  light.y = -axes->y;
  light.z = -axes->z;
  if (gltf.type == "directional") {
    light.kind = Light::Kind::kDistant;
    return light;
  }
  if (absl::Status status = SetCone(gltf.spot, where, &light); !status.ok()) return status;
  return light;
}

}  // namespace lambert

#include "radiosity/scene/light_files.h"

#include "absl/strings/match.h"
#include "radiosity/scene/ies.h"
#include "radiosity/scene/sky_map.h"

namespace lambert {

absl::Status ReadLightFiles(const SceneBundle& bundle, Scene* scene) {
  for (const auto& [name, bytes] : bundle.files) {
    if (absl::EndsWithIgnoreCase(name, ".ies")) {
      absl::StatusOr<LampProfile> lamp = ReadIes(name, bytes);
      if (!lamp.ok()) return lamp.status();
      scene->lamps[name] = *std::move(lamp);
    } else if (absl::EndsWithIgnoreCase(name, ".exr")) {
      auto sky = DecodeSkyMap(name, bytes);
      if (!sky.ok()) return sky.status();
      scene->skies[name] = *std::move(sky);
    }
  }
  return absl::OkStatus();
}

Light LampAt(const LampProfile& profile, const Transform& axes) {
  Light light;
  light.kind = Light::Kind::kLamp;
  light.position = axes.translation;
  light.strength = {1, 1, 1};
  light.x = axes.Vector(profile.x);
  light.y = axes.Vector(profile.y);
  light.z = axes.Vector(profile.z);
  light.table = profile.intensity_cd;
  return light;
}

}  // namespace lambert

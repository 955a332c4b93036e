#include "radiosity/patch/light_options.h"

#include <cmath>
#include <numbers>
#include <set>

#include "radiosity/core/error.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/scene/light_files.h"
#include "radiosity/scene/sky_map.h"

namespace lambert {
namespace {

constexpr size_t kMostTableValues = size_t{1} << 24;

absl::Status Invalid(const std::string& field, const std::string& what, const std::string& rule) {
  return MakeError(absl::StatusCode::kInvalidArgument, {"FIELD_INVALID", field, what, rule});
}

absl::StatusOr<Light> SkyOf(const Scene& scene, const LightOptions& options) {
  Light sky;
  sky.name = "sky";
  sky.kind = Light::Kind::kSky;
  sky.x = kSkyX;
  sky.y = kSkyY;
  sky.z = kSkyZ;
  sky.strength = {1, 1, 1};
  double illuminance_lx = options.sky_illuminance_lx;
  if (options.sky == "uniform" || options.sky == "overcast") {
    sky.table = options.sky == "uniform" ? UniformSky() : OvercastSky();
    if (illuminance_lx == 0) illuminance_lx = kSkyIlluminance_lx;
  } else {
    const auto found = scene.skies.find(options.sky);
    if (found == scene.skies.end()) {
      return Invalid("sky", "the scene has no sky \"" + options.sky + "\"",
                     "give uniform, overcast, or a picture as FILE.exr");
    }
    sky.table = found->second;
  }
  if (illuminance_lx == 0) return sky;
  const double own_lx = Mean(sky.table->CosineTotal());
  if (!(own_lx > 0)) {
    return Invalid("sky_illuminance_lx", "the sky \"" + options.sky + "\" is dark above",
                   "give another sky, or leave its illuminance out");
  }
  sky.strength = sky.strength * (illuminance_lx / own_lx);
  return sky;
}

Light SunOf(const LightOptions& options) {
  const double azimuth = options.sun_azimuth_deg * std::numbers::pi / 180;
  const double elevation = options.sun_elevation_deg * std::numbers::pi / 180;
  const Vec3 east{std::cos(azimuth), 0, std::sin(azimuth)};  // at right angles to the sun
  Light sun;
  sun.name = "sun";
  sun.kind = Light::Kind::kDistant;
  sun.strength = Rgb{1, 1, 1} * options.sun_illuminance_lx;
  sun.z = -Vec3{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                -std::cos(elevation) * std::cos(azimuth)};
  sun.x = east;
  sun.y = Cross(sun.z, sun.x);
  return sun;
}

absl::Status AddLamp(const Scene& scene, const LightOptions::Lamp& lamp,
                     std::vector<Light>& lights) {
  const auto profile = scene.lamps.find(lamp.file);
  if (profile == scene.lamps.end()) {
    return Invalid("ies", "the scene has no file \"" + lamp.file + "\"", "give FILE.ies=NODE");
  }
  std::vector<int32_t> nodes = NodesCalled(scene.node_names, lamp.node);
  std::erase_if(nodes, [&](int32_t node) {
    return static_cast<size_t>(node) >= scene.node_axes.size() || !scene.node_axes[node];
  });
  if (nodes.empty()) {
    return Invalid("ies", "the scene has no node \"" + lamp.node + "\" with axes",
                   "give the name or the glTF index of a node");
  }
  for (int32_t node : nodes) {
    std::erase_if(lights, [&](const Light& l) { return HasPlace(l) && l.node == node; });
    lights.push_back(LampAt(profile->second, *scene.node_axes[node]));
    lights.back().name = scene.node_names[node];
    lights.back().node = node;
  }
  return absl::OkStatus();
}

absl::Status CheckTables(const std::vector<Light>& lights) {
  std::set<const SphereTable*> tables;
  for (const Light& light : lights) {
    if (HasTable(light)) tables.insert(light.table.get());
  }
  size_t values = 0;
  for (const SphereTable* table : tables) values += table->grid().values.size();
  if (values <= kMostTableValues) return absl::OkStatus();
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"SCENE_TOO_LARGE", "lights",
                    "their tables have " + std::to_string(values) + " values, more than " +
                        std::to_string(kMostTableValues),
                    "give fewer lamps, or photometric files of fewer angles"});
}

}  // namespace

absl::Status LightOptions::Validate() const {
  const auto is_illuminance = [](double lx) { return std::isfinite(lx) && lx >= 0 && lx <= 1e15; };
  if (!is_illuminance(sky_illuminance_lx)) {
    return Invalid("sky_illuminance_lx", "out of range", "give lux from 0 to 1e15");
  }
  if (!is_illuminance(sun_illuminance_lx)) {
    return Invalid("sun_illuminance_lx", "out of range", "give lux from 0 to 1e15");
  }
  if (!(std::fabs(sun_azimuth_deg) <= 360) || !(std::fabs(sun_elevation_deg) <= 90)) {
    return Invalid("sun", "its direction is out of range",
                   "give an azimuth from -360 to 360 and an elevation from -90 to 90 degrees");
  }
  return absl::OkStatus();
}

absl::StatusOr<std::vector<Light>> LightsOf(const Scene& scene, const LightOptions& options) {
  std::vector<Light> lights = scene.lights;
  for (const LightOptions::Lamp& lamp : options.lamps) {
    if (absl::Status status = AddLamp(scene, lamp, lights); !status.ok()) return status;
  }
  if (options.sun_illuminance_lx > 0) lights.push_back(SunOf(options));
  if (!options.sky.empty()) {
    absl::StatusOr<Light> sky = SkyOf(scene, options);
    if (!sky.ok()) return sky.status();
    lights.push_back(*std::move(sky));
  }
  if (absl::Status status = CheckTables(lights); !status.ok()) return status;
  return lights;
}

}  // namespace lambert

// The lights that a user adds to a scene: a sky, a sun, lamps by their photometric files.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/scene/scene.h"

namespace lambert {

struct LightOptions {
  // "": none; "uniform"; "overcast" (CIE: the zenith three times as bright as the horizon); or the
  // name of a sky map of the scene (sky_map.h).
  std::string sky = {};
  // Horizontal illuminance of the sky where nothing hides it [lx], mean of the channels, >= 0. 0:
  // that of a sky map as it is, of the others kSkyIlluminance_lx.
  double sky_illuminance_lx = 0;
  // The sun: degrees clockwise from north (-z; east is +x) and above the horizon, -90 .. 90;
  // illuminance of a surface that faces it, >= 0, 0: no sun.
  double sun_azimuth_deg = 0, sun_elevation_deg = 45, sun_illuminance_lx = 0;
  // Each puts the lamp of an .ies file of the scene at all nodes of a name, or at the node of an
  // index, in place of point and spot lights there. It aims along the node's -z, its up is +y.
  struct Lamp {
    std::string file, node;
    bool operator==(const Lamp&) const = default;
  };
  std::vector<Lamp> lamps = {};

  // INVALID_ARGUMENT (reason FIELD_INVALID) naming the field that is out of range.
  absl::Status Validate() const;
};

// Of an overcast day, as daylight factors are given for.
inline constexpr double kSkyIlluminance_lx = 10'000;
// Of a clear day, facing the sun.
inline constexpr double kSunIlluminance_lx = 100'000;

// The lights of the scene and those of the options. FIELD_INVALID naming the option where the scene
// lacks a file or a node that it names; SCENE_TOO_LARGE for tables of over 2^24 values together.
absl::StatusOr<std::vector<Light>> LightsOf(const Scene& scene, const LightOptions& options);

}  // namespace lambert

// The luminance of the sky around a scene, as a client sends it: docs/formats.md, "sky map".
//
// A lat-long image: rows from the zenith (+y) to the nadir, columns once around. The middle column
// looks along +x, and columns turn from +x towards +z: as pictures of the surroundings are shown by
// Blender and three.js.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/vec3.h"
#include "radiosity/scene/sphere_table.h"

namespace lambert {

struct SkyMap {
  int width = 0, height = 0;  // pixels
  std::vector<float> rgb;     // nit, rows from top to bottom
};

// The most pixels that a server takes.
inline constexpr int64_t kMostSkyPixels = 1 << 21;

// Halves the image until it has few enough pixels: each takes the mean of four, by solid angle.
SkyMap FittingSky(SkyMap sky);

bool IsSkyMap(const std::string& bytes);
std::string EncodeSkyMap(const SkyMap& sky);
// The axes of its table: the pole is +y. SCENE_INVALID naming `name` for anything that EncodeSkyMap
// did not make, more than kMostSkyPixels, and luminances that are negative or not finite.
absl::StatusOr<std::shared_ptr<const SphereTable>> DecodeSkyMap(const std::string& name,
                                                                const std::string& bytes);
// A sky that is the same everywhere, of 1 nit; and the overcast sky of the CIE, 1 nit at the
// horizon and 3 at the zenith:  L = L_z (1 + 2 sin elevation) / 3. Nothing comes from below.
std::shared_ptr<const SphereTable> UniformSky();
std::shared_ptr<const SphereTable> OvercastSky();

// Axes of the tables of skies, in the world.
inline constexpr Vec3 kSkyX{1, 0, 0}, kSkyY{0, 0, 1}, kSkyZ{0, 1, 0};

}  // namespace lambert

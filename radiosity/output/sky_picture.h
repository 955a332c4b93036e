// Pictures of skies: OpenEXR -> sky map.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "radiosity/scene/sky_map.h"

namespace lambert {

// Reads the channels R, G and B of a lat-long picture in memory, one part, luminances in nit.
// Negative ones count as 0. SCENE_INVALID naming `name` where it is no such picture, or has more
// than 2^25 pixels.
absl::StatusOr<SkyMap> DecodeSkyPicture(const std::string& name, const std::string& bytes);

}  // namespace lambert

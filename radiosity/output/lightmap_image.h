// A page of a lightmap as pictures that engines read.
#pragma once

#include <string>

#include "radiosity/lightmap/lightmap.h"

namespace lambert {

// Both are linear and hold irradiance over `intensity`, rows from top to bottom.
struct LightmapImages {
  std::string rgbe;  // Radiance picture (.hdr): 8 bits a channel and a common exponent
  std::string png;   // 8 bits a channel; cut off at 1
  double intensity =
      1;  // what 99.9 % of the surface is under, by its largest channel; 1 in the dark
};

// `irradiance_lx`: of the texels of the page, dilated. Requires: as many as it has.
LightmapImages EncodeLightmapImages(const TexelPage& page, const TexelValues& irradiance_lx);

}  // namespace lambert

// Linear radiosity [lm/m2] -> what a screen shows, 0..1 in linear Rec. 709.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/core/rgb.h"

namespace lambert {

struct Exposure {
  double per_lm_per_m2 =
      1;  // display value of a radiosity of 1 lm/m2, before highlights are rolled off
};

// The exposure under which a picture of these radiosities [lm/m2] reads well: the geometric mean of
// what is lit becomes a middle gray, unless that would push more than a twentieth of the picture
// into the highlights. `reflected` holds the pixels, without what they emit; where nothing
// reflects, `emitted` decides. All zero: the exposure is 1.
Exposure ChooseExposure(const std::vector<Rgb>& reflected, const std::vector<Rgb>& emitted);

// Up to .8 the exposed value itself, so that reflectances keep their hue; brighter values approach
// 1 and fade to white (the Khronos PBR neutral tone mapper without its Fresnel term). Every channel
// of the result is in 0..1, also for values beyond the range of float.
Rgb Develop(Rgb radiosity_lm_per_m2, const Exposure& exposure);

// The sRGB byte of a display value in 0..1.
uint8_t SrgbByte(double display);

// Relative luminance of linear Rec. 709.
inline double Luminance(Rgb a) { return 0.2126 * a.r + 0.7152 * a.g + 0.0722 * a.b; }

}  // namespace lambert

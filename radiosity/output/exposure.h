// Linear radiosity [lm/m2] -> what a screen shows, 0..1 in linear Rec. 709.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/core/rgb.h"

namespace lambert {

// How values over white are met.
enum class ToneMap : uint8_t {
  kFilmic = 0,  // highlights are rolled off (KPN24)
  kLinear = 1,  // cut off at white, channel by channel
};
const char* ToneMapName(ToneMap tone_map);  // "filmic", "linear"

struct Exposure {
  double per_lm_per_m2 = 1;  // display value of a radiosity of 1 lm/m2, before the tone map
  ToneMap tone_map = ToneMap::kFilmic;
};

// What is asked of a picture.
struct PictureOptions {
  ToneMap tone_map = ToneMap::kFilmic;
  double exposure_per_lm_per_m2 = 0;  // as in Exposure; 0: chosen from what the picture shows
};

// The exposure value at ISO 100 of a factor, and back: white is a luminance of 1.2 * 2^EV cd/m2
// (LR14, 4.1), that is a radiosity of pi times as much. Requires: a factor over 0.
double Ev100Of(double exposure_per_lm_per_m2);
double ExposureOfEv100(double ev100);

// The exposure under which a picture of these radiosities [lm/m2] reads well: the geometric mean of
// what is lit becomes a middle gray, unless that would push more than a twentieth of the picture
// into the highlights. `reflected` holds the pixels, without what they emit; where nothing
// reflects, `emitted` decides. All zero: the exposure is 1.
Exposure ChooseExposure(const std::vector<Rgb>& reflected, const std::vector<Rgb>& emitted);

// Filmic: up to .8 the exposed value itself, so that reflectances keep their hue; brighter values
// approach 1 and fade to white (the Khronos PBR neutral tone mapper without its Fresnel term,
// KPN24). Linear: the exposed value, at most 1. Every channel of the result is in 0..1, also for
// values beyond the range of float.
Rgb Develop(Rgb radiosity_lm_per_m2, const Exposure& exposure);

// The sRGB byte of a display value in 0..1.
uint8_t SrgbByte(double display);

// Relative luminance of linear Rec. 709.
inline double Luminance(Rgb a) { return 0.2126 * a.r + 0.7152 * a.g + 0.0722 * a.b; }

}  // namespace lambert

// Irradiance as colours with a scale in lux, the way lighting designers read it.
#pragma once

#include <vector>

#include "radiosity/core/rgb.h"
#include "radiosity/output/picture.h"

namespace lambert {

// A logarithmic scale from low_lx to high_lx; its ends are 1, 2 or 5 times a power of ten.
struct LuxScale {
  double low_lx = 1, high_lx = 100;
  std::vector<double> ticks_lx;  // 1, 2, 5 times powers of ten within the scale

  // 0..1 along the scale; values beyond its ends stay at the ends.
  double Place(double irradiance_lx) const;
};

// The scale on which the irradiance of the picture reads well: its top is above 99 % of the pixels
// that show something, its bottom under 97 % of them but no more than two decades lower.
LuxScale ChooseLuxScale(const Picture& picture);

// The colour at 0..1 of the scale, from deep blue over green and yellow to red (Mikhailov's Turbo);
// display values, linear Rec. 709.
Rgb FalseColor(double place);

// Display values of the false-colour picture; the background is as in `picture`.
std::vector<Rgb> FalseColorPicture(const Picture& picture, const LuxScale& scale);

}  // namespace lambert

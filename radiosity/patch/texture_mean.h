// Mean of a texture over a triangle.
#pragma once

#include <array>

#include "radiosity/core/rgb.h"
#include "radiosity/scene/scene.h"

namespace lambert {

using Uv = std::array<double, 2>;

// Mean of the texels (sRGB decoded, linear 0..1; alpha left out) over the triangle whose corners
// have texture coordinates `uv`. Texels are cells of one value; four points a texel are sampled
// along the longest edge, at most `max_samples_per_edge`. Exact, up to rounding, where all texels
// under the triangle are equal. Deterministic. Requires: finite uv; a texture with pixels.
Rgb TextureMean(const Texture& texture, const std::array<Uv, 3>& uv, int max_samples_per_edge);

// Linear value of an 8-bit sRGB code.
double SrgbToLinear(uint8_t code);

}  // namespace lambert

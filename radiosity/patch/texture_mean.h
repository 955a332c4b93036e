// Means of a texture over a triangle.
#pragma once

#include <array>

#include "radiosity/core/rgb.h"
#include "radiosity/scene/scene.h"

namespace lambert {

using Uv = std::array<double, 2>;

// Both of the triangle whose corners have texture coordinates `uv`. Texels are cells of one value;
// four points a texel are sampled along the longest edge, at most `max_samples_per_edge`. Exact, up
// to rounding, where all texels under the triangle are equal. Deterministic. Require: finite uv; a
// texture with pixels.

// Mean of the texels (sRGB decoded, linear 0..1) whose alpha is `least_alpha` (0..256) or more;
// zero where there are none.
Rgb TextureMean(const Texture& texture, const std::array<Uv, 3>& uv, int max_samples_per_edge,
                int least_alpha = 0);
// The share of such texels, 0..1.
double TextureCoverage(const Texture& texture, const std::array<Uv, 3>& uv,
                       int max_samples_per_edge, int least_alpha);

// Linear value of an 8-bit sRGB code.
double SrgbToLinear(uint8_t code);

}  // namespace lambert

// Means of textures and vertex colours over a triangle.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"
#include "radiosity/scene/scene.h"

namespace lambert {

using Uv = std::array<double, 2>;

// One component of the values of a triangle's vertices, each times its weight.
template <typename Value>
double Interpolate(Vec3 weights, const std::vector<Value>& values,
                   const std::array<uint32_t, 3>& vertices, int axis) {
  return weights.x * values[vertices[0]][axis] + weights.y * values[vertices[1]][axis] +
         weights.z * values[vertices[2]][axis];
}
// Where a point of a triangle meets its texture. Requires: the primitive has TEXCOORD_n of `use`.
Uv UvAt(const TextureUse& use, const Primitive& primitive, const std::array<uint32_t, 3>& vertices,
        Vec3 weights);

// What a triangle shows at its corners: a texture, vertex colours, or both.
struct PaintedTriangle {
  const Texture* texture = nullptr;  // none: white and opaque. Requires: pixels
  std::array<Uv, 3> uv = {};         // finite
  std::array<std::array<float, 4>, 3> colors = {{{1, 1, 1, 1}, {1, 1, 1, 1}, {1, 1, 1, 1}}};
};

struct MaskedMean {
  Rgb mean;             // of texture (sRGB decoded) times colour where there is surface, 0..1
  double coverage = 1;  // the share of the triangle where there is surface
};

// The mean over `triangle`, whose surface is where alpha times that of texture and colour, as
// float32, reaches `cutoff`; zero where that is nowhere. Texels are cells of one value, colours
// linear between corners; four points a texel are sampled along the longest edge, at most
// `max_samples_per_edge`. Exact, up to rounding, where all texels under the triangle are equal and
// nothing is cut. Deterministic.
MaskedMean MeanOver(const PaintedTriangle& triangle, int max_samples_per_edge, double alpha = 1,
                    double cutoff = 0);

// Linear value of an 8-bit sRGB code.
double SrgbToLinear(uint8_t code);

}  // namespace lambert

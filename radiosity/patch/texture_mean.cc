#include "radiosity/patch/texture_mean.h"

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {

// Samples along the longest edge for every texel that it crosses: 4 find the mean of a checkerboard
// of 16 x 16 texels to 1e-3.
constexpr double kSamplesPerTexel = 4;

std::array<double, 256> MakeSrgbTable() {
  std::array<double, 256> table;
  for (int code = 0; code < 256; ++code) {
    const double x = code / 255.0;
    table[code] = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
  }
  return table;
}

// Column (or row) of the texel that holds coordinate `t`, where the texture spans 0..1.
int TexelIndex(double t, int size, Texture::Wrap wrap) {
  if (wrap == Texture::Wrap::kMirroredRepeat) {
    t = std::fabs(t - 2 * std::round(t / 2));
  } else if (wrap == Texture::Wrap::kRepeat) {
    t -= std::floor(t);
  }
  return static_cast<int>(std::clamp(std::floor(t * size), 0.0, size - 1.0));
}

// Where vertex colours alone decide what is cut.
constexpr int kAlphaSamples = 64;

int SamplesPerEdge(const PaintedTriangle& triangle, int most, bool masked) {
  const auto& colors = triangle.colors;
  const bool alpha_varies = colors[0][3] != colors[1][3] || colors[0][3] != colors[2][3];
  const double least = masked && alpha_varies ? kAlphaSamples : 1;
  const Texture* texture = triangle.texture;
  double texels = 0;
  if (texture != nullptr && (texture->width > 1 || texture->height > 1)) {
    for (int k = 0; k < 3; ++k) {
      const Uv &a = triangle.uv[k], &b = triangle.uv[(k + 1) % 3];
      texels = std::max(
          texels, std::hypot((b[0] - a[0]) * texture->width, (b[1] - a[1]) * texture->height));
    }
  }
  const double wanted = std::max(least, std::ceil(texels * kSamplesPerTexel));
  return static_cast<int>(std::min(wanted, 1.0 * most));
}

// RGBA codes of the texel at a point of the triangle.
const uint8_t* TexelAt(const PaintedTriangle& triangle, const std::array<double, 3>& weights) {
  static constexpr uint8_t kWhite[4] = {255, 255, 255, 255};
  if (triangle.texture == nullptr) return kWhite;
  const Texture& texture = *triangle.texture;
  Uv at{};
  for (int k = 0; k < 3; ++k) {
    for (int axis = 0; axis < 2; ++axis) at[axis] += weights[k] * triangle.uv[k][axis];
  }
  const int x = TexelIndex(at[0], texture.width, texture.wrap_u);
  const int y = TexelIndex(at[1], texture.height, texture.wrap_v);
  return &texture.rgba[(size_t{1} * y * texture.width + x) * 4];
}

std::array<double, 4> ColorAt(const PaintedTriangle& triangle,
                              const std::array<double, 3>& weights) {
  std::array<double, 4> color{};
  for (int k = 0; k < 3; ++k) {
    for (int c = 0; c < 4; ++c) color[c] += weights[k] * triangle.colors[k][c];
  }
  return color;
}

// Calls `visit` with the weights of the corners at each of n * n samples, where n is `per_edge`:
// the triangle is cut into n * n equal ones and sampled at their centroids, whose weights of
// corners 1 and 2 are (i + third) / n and (j + third) / n: upright cells have thirds of 1, inverted
// ones of 2.
template <typename Visit>
void ForEachSample(int per_edge, Visit visit) {
  const int n = per_edge;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      for (int inverted = 0; inverted < (i + j + 1 < n ? 2 : 1); ++inverted) {
        const double w1 = (i + (1 + inverted) / 3.0) / n, w2 = (j + (1 + inverted) / 3.0) / n;
        visit({1 - w1 - w2, w1, w2});
      }
    }
  }
}

}  // namespace

Uv UvAt(const TextureUse& use, const Primitive& primitive, const std::array<uint32_t, 3>& vertices,
        Vec3 weights) {
  const auto& coordinates = primitive.uv.at(use.uv_set);
  const double u = Interpolate(weights, coordinates, vertices, 0);
  const double v = Interpolate(weights, coordinates, vertices, 1);
  return {use.row_u[0] * u + use.row_u[1] * v + use.row_u[2],
          use.row_v[0] * u + use.row_v[1] * v + use.row_v[2]};
}

double SrgbToLinear(uint8_t code) {
  static const std::array<double, 256> table = MakeSrgbTable();
  return table[code];
}

MaskedMean MeanOver(const PaintedTriangle& triangle, int max_samples_per_edge, double alpha,
                    double cutoff) {
  const bool colored = triangle.colors != PaintedTriangle{}.colors;
  const int n = SamplesPerEdge(triangle, max_samples_per_edge, cutoff > 0);
  Rgb sum;
  int64_t count = 0;
  ForEachSample(n, [&](const std::array<double, 3>& weights) {
    const uint8_t* texel = TexelAt(triangle, weights);
    const std::array<double, 4> color =
        colored ? ColorAt(triangle, weights) : std::array<double, 4>{1, 1, 1, 1};
    // As numbers of a file are compared: in float32.
    if (static_cast<float>(texel[3] / 255.0 * alpha * color[3]) < static_cast<float>(cutoff)) {
      return;
    }
    sum = sum + Rgb{SrgbToLinear(texel[0]), SrgbToLinear(texel[1]), SrgbToLinear(texel[2])} *
                    Rgb{color[0], color[1], color[2]};
    ++count;
  });
  if (count == 0) return {{}, 0};
  const Rgb mean = sum / static_cast<double>(count);
  // Weights sum to 1 up to rounding.
  return {{std::min(mean.r, 1.0), std::min(mean.g, 1.0), std::min(mean.b, 1.0)},
          static_cast<double>(count) / (1.0 * n * n)};
}

}  // namespace lambert

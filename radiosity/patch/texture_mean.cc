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

int SamplesPerEdge(const Texture& texture, const std::array<Uv, 3>& uv, int most) {
  if (texture.width == 1 && texture.height == 1) return 1;
  double texels = 0;
  for (int k = 0; k < 3; ++k) {
    const Uv &a = uv[k], &b = uv[(k + 1) % 3];
    texels =
        std::max(texels, std::hypot((b[0] - a[0]) * texture.width, (b[1] - a[1]) * texture.height));
  }
  return static_cast<int>(std::clamp(std::ceil(texels * kSamplesPerTexel), 1.0, 1.0 * most));
}

// Calls `visit` with the RGBA codes under each sample of the triangle: n * n of them, which is
// returned.
template <typename Visit>
double ForEachSample(const Texture& texture, const std::array<Uv, 3>& uv, int most, Visit visit) {
  const int n = SamplesPerEdge(texture, uv, most);
  // The triangle is cut into n * n equal triangles; each is sampled at its centroid, whose weights
  // of corners 1 and 2 are (i + third) / n and (j + third) / n: upright cells have thirds of 1,
  // inverted ones of 2.
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      for (int inverted = 0; inverted < (i + j + 1 < n ? 2 : 1); ++inverted) {
        const double w1 = (i + (1 + inverted) / 3.0) / n, w2 = (j + (1 + inverted) / 3.0) / n;
        const double w0 = 1 - w1 - w2;
        const int x = TexelIndex(w0 * uv[0][0] + w1 * uv[1][0] + w2 * uv[2][0], texture.width,
                                 texture.wrap_u);
        const int y = TexelIndex(w0 * uv[0][1] + w1 * uv[1][1] + w2 * uv[2][1], texture.height,
                                 texture.wrap_v);
        visit(&texture.rgba[(size_t{1} * y * texture.width + x) * 4]);
      }
    }
  }
  return 1.0 * n * n;
}

}  // namespace

double SrgbToLinear(uint8_t code) {
  static const std::array<double, 256> table = MakeSrgbTable();
  return table[code];
}

Rgb TextureMean(const Texture& texture, const std::array<Uv, 3>& uv, int max_samples_per_edge,
                int least_alpha) {
  Rgb sum;
  int64_t count = 0;
  ForEachSample(texture, uv, max_samples_per_edge, [&](const uint8_t* texel) {
    if (texel[3] < least_alpha) return;
    sum = sum + Rgb{SrgbToLinear(texel[0]), SrgbToLinear(texel[1]), SrgbToLinear(texel[2])};
    ++count;
  });
  return count > 0 ? sum / static_cast<double>(count) : Rgb{};
}

double TextureCoverage(const Texture& texture, const std::array<Uv, 3>& uv,
                       int max_samples_per_edge, int least_alpha) {
  int64_t count = 0;
  const double samples =
      ForEachSample(texture, uv, max_samples_per_edge,
                    [&](const uint8_t* texel) { count += texel[3] >= least_alpha; });
  return static_cast<double>(count) / samples;
}

}  // namespace lambert

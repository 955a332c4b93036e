#include "radiosity/lightmap/lightmap.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "radiosity/patch/patch_material.h"
#include "radiosity/patch/texture_mean.h"

namespace lambert {
namespace {

constexpr int kSamplesPerEdge = 8;  // of a texture, along half of a texel's square

std::array<float, 3> ToTexel(Rgb value) {
  std::array<float, 3> stored{};
  for (int channel = 0; channel < 3; ++channel) {
    stored[channel] =
        static_cast<float>(std::min(value[channel], double{std::numeric_limits<float>::max()}));
  }
  return stored;
}

}  // namespace

TexelValues TexelIrradiance(const TexelPage& page,
                            const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx) {
  TexelValues values(page.texels.size());
  for (size_t i = 0; i < values.size(); ++i) {
    const Texel& texel = page.texels[i];
    if (texel.patch == kNoPatch) continue;
    const std::array<Rgb, 3>& corners = corner_irradiance_lx[texel.patch];
    const double u = texel.u, v = texel.v;
    values[i] = ToTexel(corners[0] * std::max(1 - u - v, 0.0) + corners[1] * u + corners[2] * v);
  }
  return values;
}

template <size_t N>
void Dilate(const TexelPage& page, std::vector<std::array<float, N>>& values, int rings) {
  std::vector<uint8_t> known(values.size());
  for (size_t i = 0; i < values.size(); ++i) known[i] = page.texels[i].patch != kNoPatch;
  std::vector<uint8_t> next = known;
  for (int ring = 0; ring < rings; ++ring) {
    for (int y = 0; y < page.height; ++y) {
      for (int x = 0; x < page.width; ++x) {
        const size_t at = static_cast<size_t>(y) * page.width + x;
        if (known[at]) continue;
        std::array<float, N> sum{};
        int count = 0;
        for (int v = std::max(y - 1, 0); v <= std::min(y + 1, page.height - 1); ++v) {
          for (int u = std::max(x - 1, 0); u <= std::min(x + 1, page.width - 1); ++u) {
            const size_t neighbour = static_cast<size_t>(v) * page.width + u;
            if (!known[neighbour]) continue;
            ++count;
            // A running mean stays finite where values are as large as numbers are.
            for (size_t channel = 0; channel < N; ++channel) {
              sum[channel] +=
                  (values[neighbour][channel] - sum[channel]) / static_cast<float>(count);
            }
          }
        }
        if (count == 0) continue;
        values[at] = sum;
        next[at] = 1;
      }
    }
    known = next;
  }
}
template void Dilate(const TexelPage& page, std::vector<std::array<float, 1>>& values, int rings);
template void Dilate(const TexelPage& page, std::vector<std::array<float, 3>>& values, int rings);

absl::StatusOr<TexelReader> TexelReader::Create(const Scene& scene, const PatchSet& patches,
                                                const Atlas& atlas) {
  std::vector<Warning> warnings;  // said when the patches were built
  absl::StatusOr<std::vector<PatchMaterial>> materials = MakePatchMaterials(scene, {}, &warnings);
  if (!materials.ok()) return materials.status();
  return TexelReader(scene, patches, atlas, *std::move(materials));
}

std::array<PaintedTriangle, 2> TexelReader::Halves(const TexelPage& page, size_t index,
                                                   const TextureUse& use) const {
  const Texel& texel = page.texels[index];
  const PlacedScene& placed = atlas_.placed;
  const SurfaceTriangle& triangle = placed.triangles[texel.triangle];
  const Primitive& primitive =
      PrimitiveOf(scene_, placed.surfaces[placed.SurfaceOf(texel.triangle)]);
  const auto& places = patches_.is_back[texel.patch] ? atlas_.back : atlas_.front;
  const auto x = static_cast<double>(index % page.width);
  const auto y = static_cast<double>(index / page.width);
  const Point2 corners[4] = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
  const int halves[2][3] = {{0, 1, 2}, {0, 2, 3}};
  std::array<PaintedTriangle, 2> painted;
  for (int half = 0; half < 2; ++half) {
    if (use.texture >= 0) painted[half].texture = &scene_.textures[use.texture];
    for (int k = 0; k < 3; ++k) {
      const Vec3 weights = WeightsAt(places[texel.triangle].texel, corners[halves[half][k]]);
      if (use.texture >= 0) {
        painted[half].uv[k] = UvAt(use, primitive, triangle.vertices, weights);
      }
      if (primitive.colors.empty()) continue;
      for (int c = 0; c < 4; ++c) {
        // Beyond the triangle the line from corner to corner may leave 0..1.
        painted[half].colors[k][c] = std::clamp(
            static_cast<float>(Interpolate(weights, primitive.colors, triangle.vertices, c)), 0.0f,
            1.0f);
      }
    }
  }
  return painted;
}

TexelSurface TexelReader::At(const TexelPage& page, size_t index) const {
  const Texel& texel = page.texels[index];
  const PlacedSurface& surface = atlas_.placed.surfaces[atlas_.placed.SurfaceOf(texel.triangle)];
  const PatchMaterial& material = materials_[PrimitiveOf(scene_, surface).material + 1];
  Rgb reflectance, exitance;
  double covered = 0;
  for (const PaintedTriangle& half : Halves(page, index, material.reflectance_texture)) {
    const MaskedMean mean = MeanOver(half, kSamplesPerEdge, material.alpha, material.alpha_cutoff);
    reflectance = reflectance + mean.mean * mean.coverage;
    covered += mean.coverage;
  }
  for (PaintedTriangle half : Halves(page, index, material.exitance_texture)) {
    half.colors = PaintedTriangle{}.colors;
    exitance = exitance + MeanOver(half, kSamplesPerEdge).mean * 0.5;
  }
  // Where alpha cuts all of the texel away, the patch's own mean fills the hole.
  return {covered > 0 ? material.reflectance * reflectance / covered
                      : patches_.reflectance[texel.patch],
          material.exitance_lm_per_m2 * exitance, covered / 2};
}

}  // namespace lambert

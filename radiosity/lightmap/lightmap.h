// What is seen of a scene in the texels of its atlas.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "radiosity/lightmap/atlas.h"
#include "radiosity/patch/patch_material.h"
#include "radiosity/patch/texture_mean.h"

namespace lambert {

// The point of a patch that a texel stands for.
struct Texel {
  PatchIndex patch = kNoPatch;  // kNoPatch: no surface lies in the texel
  float u = 0, v = 0;           // weights of corners 1 and 2 of the patch
  int32_t triangle = -1;        // PlacedScene::triangles
};

// Rows from top to bottom.
struct TexelPage {
  int width = 0, height = 0;
  std::vector<Texel> texels;
};

// Which point each texel shows: of 17 points of the texel, its centre first, the one nearest to the
// centre that lies on a patch. So a texel at the border of a chart shows the surface that is there,
// and no darkness beyond it. A patch smaller than a texel shows with its centroid where nothing is
// nearer. Patches of two-sided triangles are in the regions of their side.
// Requires: `atlas` was built of these.
std::vector<TexelPage> FindTexels(const Scene& scene, const PatchSet& patches, const Atlas& atlas);

// The point of a texel [m, relative to the patch set's origin]. Requires: texel.patch != kNoPatch.
Vec3 TexelPoint(const PatchSet& patches, const Texel& texel);

// A value a texel, as they are stored.
using TexelValues = std::vector<std::array<float, 3>>;

// The light in every texel of a page, linear between the corners of its patch
// (`corner_irradiance_lx` from SmoothIrradiance, by patch) [lx]; 0 where there is no surface.
TexelValues TexelIrradiance(const TexelPage& page,
                            const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx);

// Gives texels without a surface the mean of their neighbours that have a value, ring by ring:
// what a viewer mixes in at the border of a chart, and from smaller levels of the picture. For N =
// 1 and 3.
inline constexpr int kDilation = 16;
template <size_t N>
void Dilate(const TexelPage& page, std::vector<std::array<float, N>>& values,
            int rings = kDilation);

// What a texel's surface reflects (0..1) and emits [lm/m2].
struct TexelSurface {
  Rgb reflectance, exitance_lm_per_m2;
  double coverage = 1;  // the share of the texel that alpha mode MASK leaves
};

// Reads materials texel by texel. Immutable; the scene, patches and atlas must outlive it.
class TexelReader {
 public:
  // Fails as BuildPatches would.
  static absl::StatusOr<TexelReader> Create(const Scene& scene, const PatchSet& patches,
                                            const Atlas& atlas);

  // Textures and vertex colours averaged over texel `index` of the page, with 128 samples at most.
  // Requires: its patch is not kNoPatch.
  TexelSurface At(const TexelPage& page, size_t index) const;

 private:
  TexelReader(const Scene& scene, const PatchSet& patches, const Atlas& atlas,
              std::vector<PatchMaterial> materials)
      : scene_(scene), patches_(patches), atlas_(atlas), materials_(std::move(materials)) {}
  // The two halves of the texel's square.
  std::array<PaintedTriangle, 2> Halves(const TexelPage& page, size_t index,
                                        const TextureUse& use) const;

  const Scene& scene_;
  const PatchSet& patches_;
  const Atlas& atlas_;
  std::vector<PatchMaterial> materials_;
};

}  // namespace lambert

// Where every surface of a scene lies in its lightmap.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/warning.h"
#include "radiosity/lightmap/chart.h"
#include "radiosity/lightmap/pack.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/scene/scene.h"

namespace lambert {

struct LightmapOptions {
  // Density; 0: kDefaultDensity, or less where the surfaces would take more than kDefaultTexels.
  double texels_per_meter = 0;
  int largest_page = kLargestPage;  // texels a side; a power of two, kSmallestPage .. kLargestPage
};
inline constexpr double kDefaultDensity = 64;         // texels a metre
inline constexpr double kDefaultTexels = 512 * 1024;  // half a page of 1024 x 1024
inline constexpr int kPadding = 2;                    // texels around each chart

// Where one side of a triangle lies. Corners in the order of SurfaceTriangle::corners.
struct AtlasPlace {
  int32_t page = -1;  // -1: nowhere
  int32_t chart = -1;
  FlatTriangle texel{};  // from the upper left corner of the page, x to the right, y down
};

struct Atlas {
  double texels_per_meter = 0;
  std::vector<PageSize> pages;
  PlacedScene placed;
  // By surface: the TEXCOORD_n whose shape was kept; -1: own charts.
  std::vector<int32_t> kept_uv;
  std::vector<AtlasPlace> front, back;  // by triangle; `back` is empty where none has a back
  std::vector<Warning> warnings;
};

// Lays out the front of every triangle that has an area, and the back of those that have patches
// there. Existing texture coordinates that are unique are kept as they are shaped (TEXCOORD_1, then
// TEXCOORD_0); else charts by normal and adjacency. Charts are kPadding texels and more from each
// other's. Depends on the scene and the patches' corners alone. A density that needs more than
// kMostPages is reduced with the warning LIGHTMAP_REDUCED. RESOURCE_EXHAUSTED (reason
// LIGHTMAP_TOO_LARGE) where there are more charts than texels.
// Requires: `patches` was built of `scene`.
absl::StatusOr<Atlas> BuildAtlas(const Scene& scene, const PatchSet& patches,
                                 const LightmapOptions& options);

}  // namespace lambert

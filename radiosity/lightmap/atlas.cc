#include "radiosity/lightmap/atlas.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr double kDensityStep = 0.85;  // of a reduction
constexpr int kMostReductions = 80;    // to a millionth

// The charts of one side of one surface.
struct SurfaceCharts {
  int32_t first;  // triangle of the surface
  bool is_back;
  std::vector<Chart> charts;
};

// The charts of every surface, and again for the backs of those that have any.
std::vector<SurfaceCharts> ChartSurfaces(const Scene& scene, const PatchSet& patches,
                                         Atlas& atlas) {
  std::set<std::tuple<int32_t, int32_t>> two_sided;  // node and primitive
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (patches.is_back[i]) two_sided.emplace(patches.source[i].node, patches.source[i].primitive);
  }
  std::vector<SurfaceCharts> charted;
  for (const PlacedSurface& surface : atlas.placed.surfaces) {
    const auto begin = atlas.placed.triangles.begin() + surface.first;
    const std::vector<SurfaceTriangle> triangles(begin, begin + surface.count);
    const Primitive& primitive = PrimitiveOf(scene, surface);
    SurfaceCharts made{surface.first, false, {}};
    atlas.kept_uv.push_back(-1);
    for (int set = 1; set >= 0 && made.charts.empty(); --set) {
      const auto uv = primitive.uv.find(set);
      if (uv == primitive.uv.end()) continue;
      made.charts = ChartsOfUv(triangles, uv->second);
      if (!made.charts.empty()) atlas.kept_uv.back() = set;
    }
    if (made.charts.empty()) made.charts = ChartsByNormal(triangles);
    charted.push_back(made);
    const int32_t node = scene.instances[surface.instance].node;
    if (!two_sided.contains({node, surface.primitive})) continue;
    made.is_back = true;
    charted.push_back(std::move(made));
    atlas.back.resize(atlas.placed.triangles.size());
  }
  return charted;
}

double TotalArea(const std::vector<SurfaceCharts>& charted) {
  double area_m2 = 0;
  for (const SurfaceCharts& side : charted) {
    for (const Chart& chart : side.charts) area_m2 += chart.size_m[0] * chart.size_m[1];
  }
  return area_m2;
}

// Texels that a length takes, padding included; too many for any page where it passes one.
int Texels(double length_m, double density) {
  return static_cast<int>(std::clamp(std::ceil(length_m * density), 1.0, 2.0 * kLargestPage)) +
         2 * kPadding;
}

// Packs at the atlas's density; false where it does not fit.
bool Place(const std::vector<SurfaceCharts>& charted, int largest_page, Atlas& atlas) {
  const double density = atlas.texels_per_meter;
  std::vector<PackedRectangle> rectangles;
  for (const SurfaceCharts& side : charted) {
    for (const Chart& chart : side.charts) {
      rectangles.push_back(
          {Texels(chart.size_m[0], density), Texels(chart.size_m[1], density), 0, 0, 0});
    }
  }
  atlas.pages = PackRectangles(rectangles, largest_page);
  if (atlas.pages.empty()) return false;
  atlas.front.assign(atlas.placed.triangles.size(), {});
  int32_t index = 0;
  for (const SurfaceCharts& side : charted) {
    for (const Chart& chart : side.charts) {
      const PackedRectangle& at = rectangles[index];
      for (size_t i = 0; i < chart.triangles.size(); ++i) {
        AtlasPlace& place =
            (side.is_back ? atlas.back : atlas.front)[side.first + chart.triangles[i]];
        place.page = at.page;
        place.chart = index;
        for (int k = 0; k < 3; ++k) {
          place.texel[k] = {at.x + kPadding + chart.flat_m[i][k][0] * density,
                            at.y + kPadding + chart.flat_m[i][k][1] * density};
        }
      }
      ++index;
    }
  }
  return true;
}

}  // namespace

absl::StatusOr<Atlas> BuildAtlas(const Scene& scene, const PatchSet& patches,
                                 const LightmapOptions& options) {
  Atlas atlas;
  atlas.placed = PlaceScene(scene, patches.origin);
  const std::vector<SurfaceCharts> charted = ChartSurfaces(scene, patches, atlas);
  const bool by_size = !(options.texels_per_meter > 0);
  const double wanted =
      by_size ? std::min(kDefaultDensity, std::sqrt(kDefaultTexels / TotalArea(charted)))
              : options.texels_per_meter;
  atlas.texels_per_meter = wanted;
  const std::string room =
      absl::StrCat(kMostPages, " pages of ", options.largest_page, " x ", options.largest_page);
  int reductions = 0;
  while (!Place(charted, options.largest_page, atlas)) {
    if (++reductions > kMostReductions) {
      return MakeError(absl::StatusCode::kResourceExhausted,
                       {"LIGHTMAP_TOO_LARGE", "lightmap",
                        absl::StrCat("its charts do not fit on ", room, " texels"),
                        "bake a scene of fewer surfaces"});
    }
    atlas.texels_per_meter *= kDensityStep;
  }
  if (reductions > 0) {
    atlas.warnings.push_back(
        {"LIGHTMAP_REDUCED",
         absl::StrCat("the lightmap has ", atlas.texels_per_meter, " texels a metre in place of ",
                      wanted, ": more do not fit on ", room, " texels")});
  }
  return atlas;
}

}  // namespace lambert

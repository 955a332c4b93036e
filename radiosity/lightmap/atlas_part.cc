#include "radiosity/lightmap/atlas_part.h"

#include <map>
#include <utility>

namespace lambert {
namespace {

// Puts triangles of one side of one surface where they belong.
class PartMaker {
 public:
  PartMaker(const Atlas& atlas, int32_t surface, bool is_back)
      : atlas_(atlas), surface_(surface), is_back_(is_back) {}

  void Add(int32_t triangle) {
    const AtlasPlace& place = (is_back_ ? atlas_.back : atlas_.front)[triangle];
    AtlasPart& part = parts_[place.page];
    part.surface = surface_;
    part.page = place.page;
    part.is_back = is_back_;
    std::array<uint32_t, 3> corners{};
    for (int k = 0; k < 3; ++k) corners[k] = VertexOf(triangle, k, place, part);
    if (is_back_) std::swap(corners[1], corners[2]);
    part.triangles.push_back(corners);
  }

  void MoveTo(std::vector<AtlasPart>& parts) {
    for (auto& [page, part] : parts_) parts.push_back(std::move(part));
  }

 private:
  // Charts share no vertex: each has texels of its own.
  uint32_t VertexOf(int32_t triangle, int corner, const AtlasPlace& place, AtlasPart& part) {
    const SurfaceTriangle& placed = atlas_.placed.triangles[triangle];
    const uint32_t source = placed.vertices[corner];
    const auto [found, is_new] =
        known_.try_emplace({place.chart, source}, static_cast<uint32_t>(part.source.size()));
    if (is_new) {
      const PageSize& page = atlas_.pages[place.page];
      part.source.push_back(source);
      part.position_m.push_back(placed.corners[corner]);
      part.uv.push_back({static_cast<float>(place.texel[corner][0] / page.width),
                         static_cast<float>(place.texel[corner][1] / page.height)});
    }
    return found->second;
  }

  const Atlas& atlas_;
  const int32_t surface_;
  const bool is_back_;
  std::map<int32_t, AtlasPart> parts_;                      // by page
  std::map<std::pair<int32_t, uint32_t>, uint32_t> known_;  // chart and vertex: vertex of the part
};

}  // namespace

bool IsMasked(const Scene& scene, const Atlas& atlas, const AtlasPart& part) {
  const int32_t material = PrimitiveOf(scene, atlas.placed.surfaces[part.surface]).material;
  return material >= 0 && scene.materials[material].alpha_cutoff > 0;
}

AtlasSides SidesWithPatches(const Scene& scene, const PatchSet& patches, const Atlas& atlas) {
  AtlasSides sides{std::vector<bool>(atlas.front.size()), std::vector<bool>(atlas.back.size())};
  const std::vector<int32_t> triangles = FindTriangles(scene, atlas.placed, patches);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const bool is_back = patches.is_back[i] != 0;
    if ((is_back ? atlas.back : atlas.front)[triangles[i]].page < 0) continue;
    (is_back ? sides.back : sides.front)[triangles[i]] = true;
  }
  return sides;
}

std::vector<AtlasPart> PartsOf(const Atlas& atlas, const AtlasSides& sides) {
  std::vector<AtlasPart> parts;
  for (size_t s = 0; s < atlas.placed.surfaces.size(); ++s) {
    const PlacedSurface& surface = atlas.placed.surfaces[s];
    for (const bool is_back : {false, true}) {
      const std::vector<bool>& wanted = is_back ? sides.back : sides.front;
      if (wanted.empty()) continue;
      PartMaker maker(atlas, static_cast<int32_t>(s), is_back);
      for (int32_t t = surface.first; t < surface.first + surface.count; ++t) {
        if (wanted[t]) maker.Add(t);
      }
      maker.MoveTo(parts);
    }
  }
  return parts;
}

}  // namespace lambert

// The triangles of an atlas as meshes have them: with shared vertices, page by page.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/lightmap/atlas.h"

namespace lambert {

// Triangles of one side of one surface that lie on one page.
struct AtlasPart {
  int32_t surface = 0, page = 0;
  bool is_back = false;
  // By vertex:
  std::vector<uint32_t> source;          // vertex of the primitive
  std::vector<Vec3> position_m;          // relative to the patch set's origin
  std::vector<std::array<float, 2>> uv;  // on the page, (0, 0) its upper left corner, 0..1
  std::vector<std::array<uint32_t, 3>> triangles;  // counter-clockwise seen from the part's side
};

// Whether alpha mode MASK cuts parts of the surface away.
bool IsMasked(const Scene& scene, const Atlas& atlas, const AtlasPart& part);

// Which triangles of the atlas are to be there, by side.
struct AtlasSides {
  std::vector<bool> front, back;
};

// Those of which there are patches.
AtlasSides SidesWithPatches(const Scene& scene, const PatchSet& patches, const Atlas& atlas);

// In the order of the surfaces, fronts before backs, by page.
std::vector<AtlasPart> PartsOf(const Atlas& atlas, const AtlasSides& sides);

}  // namespace lambert

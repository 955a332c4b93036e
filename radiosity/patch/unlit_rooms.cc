#include "radiosity/patch/unlit_rooms.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>

#include "radiosity/core/bounds.h"
#include "radiosity/core/disjoint_sets.h"

namespace lambert {
namespace {

// More boxes of rooms and lights than this are not compared, and the rooms count as lit.
constexpr double kMostComparisons = 1e8;

// Six times the volume that faces enclose, negative where they look inward.
double SignedVolume(const PatchSet& patches, const std::vector<PatchIndex>& faces) {
  const Vec3 origin = patches.corners[faces.front()][0];
  double volume = 0;
  for (PatchIndex i : faces) {
    const auto& c = patches.corners[i];
    volume += Dot(c[0] - origin, Cross(c[1] - origin, c[2] - origin));
  }
  return volume;
}

// One side of a node, where it looks inward on the whole: what may hold rooms.
std::vector<std::vector<PatchIndex>> InwardSides(const PatchSet& patches) {
  std::map<std::pair<int32_t, uint8_t>, std::vector<PatchIndex>> sides;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    sides[{patches.source[i].node, patches.is_back[i]}].push_back(i);
  }
  std::vector<std::vector<PatchIndex>> inward;
  for (auto& [side, faces] : sides) {
    if (SignedVolume(patches, faces) < 0) inward.push_back(std::move(faces));
  }
  return inward;
}

using Place = std::array<double, 3>;
Place PlaceOf(Vec3 p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }  // -0 is 0

// An edge with its ends in order; `forward`: as the face runs.
struct Edge {
  int32_t low, high;
  bool forward;
  int32_t face;
  auto operator<=>(const Edge&) const = default;
};

std::vector<Edge> EdgesOf(const PatchSet& patches, const std::vector<PatchIndex>& faces) {
  std::vector<std::pair<Place, int32_t>> places;  // of corner 3 face + k
  for (size_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      places.push_back({PlaceOf(patches.corners[faces[f]][k]), static_cast<int32_t>(3 * f + k)});
    }
  }
  std::sort(places.begin(), places.end());
  std::vector<int32_t> vertex(places.size());
  for (size_t k = 0, number = 0; k < places.size(); ++k) {
    if (k > 0 && places[k].first != places[k - 1].first) ++number;
    vertex[places[k].second] = static_cast<int32_t>(number);
  }
  std::vector<Edge> edges;
  for (size_t f = 0; f < faces.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int32_t a = vertex[3 * f + k], b = vertex[3 * f + (k + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), a < b, static_cast<int32_t>(f)});
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Faces that hang together by edges of two, without those that have an edge of any other kind.
std::vector<std::vector<PatchIndex>> ClosedShells(const PatchSet& patches,
                                                  const std::vector<PatchIndex>& faces) {
  const std::vector<Edge> edges = EdgesOf(patches, faces);
  DisjointSets shell_of(faces.size());
  std::vector<bool> is_open(faces.size());
  for (size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    const auto is_same = [&](const Edge& e) {
      return e.low == edges[begin].low && e.high == edges[begin].high;
    };
    while (end < edges.size() && is_same(edges[end])) ++end;
    const bool is_closed = end == begin + 2 && edges[begin].forward != edges[begin + 1].forward;
    for (size_t e = begin; e < end; ++e) {
      if (!is_closed) is_open[edges[e].face] = true;
      shell_of.Join(edges[e].face, edges[begin].face);
    }
  }
  std::map<int32_t, std::vector<PatchIndex>> shells;
  std::vector<bool> has_hole(faces.size());  // by root
  for (size_t f = 0; f < faces.size(); ++f) {
    const int32_t root = shell_of.Find(static_cast<int32_t>(f));
    shells[root].push_back(faces[f]);
    if (is_open[f]) has_hole[root] = true;
  }
  std::vector<std::vector<PatchIndex>> closed;
  for (auto& [root, shell] : shells) {
    if (!has_hole[root] && SignedVolume(patches, shell) < 0) closed.push_back(std::move(shell));
  }
  return closed;
}

Bounds BoundsOf(const PatchSet& patches, const std::vector<PatchIndex>& faces) {
  Bounds bounds{patches.corners[faces.front()][0], patches.corners[faces.front()][0]};
  for (PatchIndex i : faces) {
    for (const Vec3& p : patches.corners[i]) bounds.Add(p);
  }
  return bounds;
}

std::vector<Bounds> LightsOf(const PatchSet& patches) {
  std::vector<Bounds> lights;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (patches.exitance_lm_per_m2[i] != Rgb{}) lights.push_back(BoundsOf(patches, {i}));
  }
  // Light from outside does not get into a closed room.
  for (const Light& light : patches.lights) {
    if (HasPlace(light)) lights.push_back({light.position, light.position});
  }
  return lights;
}

// Whether a light reaches into the inside of a box.
bool Meets(const Bounds& light, const Bounds& room) {
  return light.high.x > room.low.x && light.low.x < room.high.x && light.high.y > room.low.y &&
         light.low.y < room.high.y && light.high.z > room.low.z && light.low.z < room.high.z;
}

}  // namespace

std::vector<bool> FindUnlitWalls(const PatchSet& patches) {
  std::vector<bool> unlit(patches.size());
  std::vector<std::vector<PatchIndex>> rooms;
  for (const auto& side : InwardSides(patches)) {
    for (auto& shell : ClosedShells(patches, side)) rooms.push_back(std::move(shell));
  }
  if (rooms.empty()) return unlit;
  const std::vector<Bounds> lights = LightsOf(patches);
  if (static_cast<double>(rooms.size()) * static_cast<double>(lights.size()) > kMostComparisons) {
    return unlit;
  }
  for (const auto& room : rooms) {
    const Bounds box = BoundsOf(patches, room);
    const bool is_lit = std::any_of(lights.begin(), lights.end(),
                                    [&box](const Bounds& light) { return Meets(light, box); }) ||
                        std::any_of(room.begin(), room.end(), [&](PatchIndex i) {
                          return patches.exitance_lm_per_m2[i] != Rgb{};
                        });
    for (PatchIndex i : room) unlit[i] = !is_lit;
  }
  return unlit;
}

}  // namespace lambert

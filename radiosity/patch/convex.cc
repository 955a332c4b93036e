#include "radiosity/patch/convex.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

namespace lambert {
namespace {

constexpr double kTolerance = 1e-6;  // of the diagonal: twice the height at which rays start
constexpr double kMostTests = 1e8;   // about a tenth of a second

// Every place once: neighbours share most.
std::vector<Vec3> PlacesOf(const PatchSet& patches) {
  std::set<std::array<double, 3>> places;
  for (const auto& corners : patches.corners) {
    for (const Vec3& p : corners) places.insert({p.x, p.y, p.z});
  }
  for (const Light& light : patches.lights) {
    if (HasPlace(light)) places.insert({light.position.x, light.position.y, light.position.z});
  }
  std::vector<Vec3> list;
  for (const auto& p : places) list.push_back({p[0], p[1], p[2]});
  return list;
}

}  // namespace

bool IsConvex(const PatchSet& patches) {
  const std::vector<Vec3> places = PlacesOf(patches);
  if (places.empty()) return true;
  Bounds bounds{places.front(), places.front()};
  for (const Vec3& p : places) bounds.Add(p);
  const double least = -kTolerance * bounds.Diagonal();
  double tests = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Vec3 normal = PatchNormal(patches, i), corner = patches.corners[i][0];
    tests += static_cast<double>(places.size());
    const bool is_lit_from_behind =
        std::any_of(patches.lights.begin(), patches.lights.end(), [&](const Light& light) {
          return light.kind == Light::Kind::kSky ||
                 (light.kind == Light::Kind::kDistant && Dot(light.z, normal) > 0);
        });
    const bool has_back =
        is_lit_from_behind || std::any_of(places.begin(), places.end(), [&](const Vec3& p) {
          return Dot(p - corner, normal) < least;
        });
    if (has_back || tests > kMostTests) return false;
  }
  return true;
}

}  // namespace lambert

#include "radiosity/patch/light.h"

#include <cmath>
#include <limits>

#include "radiosity/patch/cone.h"

namespace lambert {

int LightCount(const PatchSet& patches) { return static_cast<int>(patches.lights.size()); }

double ProjectedArea(const Bounds& box, const Vec3& direction) {
  const Vec3 size = box.Size();
  return size.y * size.z * std::fabs(direction.x) + size.z * size.x * std::fabs(direction.y) +
         size.x * size.y * std::fabs(direction.z);
}

std::vector<Rgb> LightFlux(const PatchSet& patches) {
  std::vector<Rgb> flux_lm;
  if (patches.lights.empty()) return flux_lm;
  const Bounds box = BoundsOf(patches);
  for (const Light& light : patches.lights) {
    flux_lm.push_back(light.strength * (light.kind == Light::Kind::kDistant
                                            ? ProjectedArea(box, light.z)
                                            : Cone(light.cos_inner, light.cos_outer).SolidAngle()));
  }
  return flux_lm;
}

bool IsDelta(const PatchSet&, int) { return true; }

LightSample SampleLight(const PatchSet& patches, int light, const Vec3& point, double, double) {
  const Light& from = patches.lights[light];
  if (from.kind == Light::Kind::kDistant) {
    return {-from.z, std::numeric_limits<double>::infinity(), from.strength};
  }
  const Vec3 way = from.position - point;
  const double square_m2 = Dot(way, way);
  if (!(square_m2 > 0)) return {{0, 0, 1}, 0, {}};
  const double distance_m = std::sqrt(square_m2);
  const Vec3 direction = way / distance_m;
  const double factor = Cone(from.cos_inner, from.cos_outer).Factor(-Dot(direction, from.z));
  return {direction, distance_m, from.strength * (factor / square_m2)};
}

}  // namespace lambert

#include "radiosity/patch/light.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "radiosity/patch/cone.h"

namespace lambert {

int LightCount(const PatchSet& patches) { return static_cast<int>(patches.lights.size()); }

double ProjectedArea(const Bounds& box, const Vec3& direction) {
  const Vec3 size = box.Size();
  return size.y * size.z * std::fabs(direction.x) + size.z * size.x * std::fabs(direction.y) +
         size.x * size.y * std::fabs(direction.z);
}

double DiskArea(const Bounds& box) {
  return std::numbers::pi / 4 * box.Diagonal() * box.Diagonal();
}

namespace {

Rgb FluxOf(const Light& light, const Bounds& box) {
  switch (light.kind) {
    case Light::Kind::kPoint:
      return light.strength * Cone(light.cos_inner, light.cos_outer).SolidAngle();
    case Light::Kind::kDistant:
      return light.strength * ProjectedArea(box, light.z);
    case Light::Kind::kLamp:
      return light.strength * light.table->total();
    case Light::Kind::kSky:
      return light.strength * light.table->total() * DiskArea(box);
  }
  return {};
}

// Of the strength of a light with a place.
Rgb FactorToward(const Light& light, const Vec3& direction) {
  if (light.kind == Light::Kind::kPoint) {
    return Rgb{1, 1, 1} * Cone(light.cos_inner, light.cos_outer).Factor(Dot(direction, light.z));
  }
  return light.table->Value(
      {Dot(direction, light.x), Dot(direction, light.y), Dot(direction, light.z)});
}

LightSample SampleSky(const Light& sky, double u, double v) {
  if (sky.table->total() == Rgb{}) return {{0, 1, 0}, std::numeric_limits<double>::infinity(), {}};
  const SphereTable::Sample sample = sky.table->Draw(u, v);
  const Vec3 d = sample.direction;
  return {sky.x * d.x + sky.y * d.y + sky.z * d.z, std::numeric_limits<double>::infinity(),
          sky.strength * sample.value / sample.density};
}

}  // namespace

std::vector<Rgb> LightFlux(const PatchSet& patches) {
  std::vector<Rgb> flux_lm;
  if (patches.lights.empty()) return flux_lm;
  const Bounds box = BoundsOf(patches);
  for (const Light& light : patches.lights) flux_lm.push_back(FluxOf(light, box));
  return flux_lm;
}

bool IsDelta(const PatchSet& patches, int light) {
  return patches.lights[light].kind != Light::Kind::kSky;
}

LightSample SampleLight(const PatchSet& patches, int light, const Vec3& point, double u, double v) {
  const Light& from = patches.lights[light];
  if (from.kind == Light::Kind::kSky) return SampleSky(from, u, v);
  if (from.kind == Light::Kind::kDistant) {
    return {-from.z, std::numeric_limits<double>::infinity(), from.strength};
  }
  const Vec3 way = from.position - point;
  const double square_m2 = Dot(way, way);
  if (!(square_m2 > 0)) return {{0, 0, 1}, 0, {}};
  const double distance_m = std::sqrt(square_m2);
  const Vec3 direction = way / distance_m;
  return {direction, distance_m, from.strength * FactorToward(from, -direction) / square_m2};
}

}  // namespace lambert

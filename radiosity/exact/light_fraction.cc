#include "radiosity/exact/light_fraction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/exact/form_factor.h"
#include "radiosity/patch/light.h"

namespace lambert {
namespace {

constexpr double kTolerance =
    1e-10;  // of the light's flux, for each triangle that is not cut further
constexpr int kLeastDepth = 3, kMostDepth = 16;
// Larger parts, by edge over distance from the light, may hide what it does inside them.
constexpr double kMostSize = 0.25;

double AreaOf(const Triangle& t) { return 0.5 * Length(Cross(t[1] - t[0], t[2] - t[0])); }

bool ShinesAllAround(const Light& light) {
  return light.kind == Light::Kind::kPoint && light.cos_outer == -1 && light.cos_inner == -1;
}

}  // namespace

LightFraction::LightFraction(const PatchSet& patches, int light)
    : patches_(patches),
      light_(light),
      flux_lm_(Mean(LightFlux(patches)[light])),
      outside_m_(2 * BoundsOf(patches).Diagonal()) {}

Vec3 LightFraction::place() const {
  const Light& light = patches_.lights[light_];
  return HasPlace(light) ? light.position : SeenFrom(patches_.corners[0][0]);
}

Vec3 LightFraction::SeenFrom(const Vec3& point) const {
  const Light& light = patches_.lights[light_];
  return HasPlace(light) ? light.position : point - light.z * outside_m_;
}

double LightFraction::Density(const Vec3& point, const Vec3& normal) const {
  if (!(flux_lm_ > 0)) return 0;
  const LightSample sample = SampleLight(patches_, light_, point, 0, 0);
  return Mean(sample.illuminance_lx) * std::max(0.0, Dot(sample.direction, normal)) / flux_lm_;
}

// Mean over the midpoints of the edges: exact for squares.
double LightFraction::Rule(const Triangle& t, const Vec3& normal) const {
  const double sum = Density((t[0] + t[1]) / 2, normal) + Density((t[1] + t[2]) / 2, normal) +
                     Density((t[2] + t[0]) / 2, normal);
  return sum / 3 * AreaOf(t);
}

double LightFraction::Quadrature(const Triangle& t, const Vec3& normal, double whole,
                                 int depth) const {
  const Vec3 a = (t[0] + t[1]) / 2, b = (t[1] + t[2]) / 2, c = (t[2] + t[0]) / 2;
  const Triangle parts[4] = {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}};
  double fine[4], sum = 0;
  for (int k = 0; k < 4; ++k) sum += fine[k] = Rule(parts[k], normal);
  if (depth >= kMostDepth) return sum;
  const double edge_m = std::max({Length(t[1] - t[0]), Length(t[2] - t[1]), Length(t[0] - t[2])});
  const double distance_m = Length((t[0] + t[1] + t[2]) / 3 - place());
  if (depth >= kLeastDepth && edge_m < kMostSize * distance_m &&
      std::fabs(sum - whole) < kTolerance) {
    return sum;
  }
  sum = 0;
  for (int k = 0; k < 4; ++k) sum += Quadrature(parts[k], normal, fine[k], depth + 1);
  return sum;
}

double LightFraction::Of(const Triangle& triangle) const {
  const Light& light = patches_.lights[light_];
  if (ShinesAllAround(light)) {
    return SolidAngleFrom(light.position, triangle) / (4 * std::numbers::pi);
  }
  const Vec3 normal = PlaneOf(triangle).normal;
  if (!HasPlace(light)) return Density(triangle[0], normal) * AreaOf(triangle);
  if (!(Dot(light.position - triangle[0], normal) > 0)) return 0;
  return Quadrature(triangle, normal, Rule(triangle, normal), 0);
}

}  // namespace lambert

#include "radiosity/shoot/light_rays.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/core/sin_cos.h"

namespace lambert {
namespace {

// How far outside the box parallel rays start, in trace coordinates: no rounding puts one inside.
constexpr double kOutside = 1e-3;

double Component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3 Along(int axis, double length) {
  return {axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0};
}

}  // namespace

LightRays::LightRays(const Light& light, const Bounds& box, const RayScene& scene)
    : kind_(light.kind),
      position_(scene.ToTrace(light.position)),
      x_(light.x),
      y_(light.y),
      z_(light.z),
      cone_(light.cos_inner, light.cos_outer) {
  if (kind_ == Light::Kind::kDistant) AddFaces({scene.ToTrace(box.low), scene.ToTrace(box.high)});
}

void LightRays::AddFaces(const Bounds& box) {
  const Vec3 size = box.Size();
  double area = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = Component(z_, axis);
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    area += Component(size, a) * Component(size, b) * std::fabs(along);
    const Vec3 corner =
        along > 0 ? box.low : box.low + Along(axis, Component(size, axis));  // the near face
    faces_.push_back({corner, Along(a, Component(size, a)), Along(b, Component(size, b)), area});
  }
  for (Face& face : faces_) face.until = area > 0 ? face.until / area : 1;
}

LightRays::Ray LightRays::FromPlace(double u, double v) const {
  const double z = cone_.SampleCosine(u);
  const SineCosine angle = SinCos(std::numbers::pi * (2 * v - 1));
  const double radius = std::sqrt(std::max(0.0, 1 - z * z));
  return {position_, x_ * (radius * angle.cosine) + y_ * (radius * angle.sine) + z_ * z};
}

LightRays::Ray LightRays::ThroughBox(double u, double v) const {
  size_t k = 0;
  while (k + 1 < faces_.size() && u >= faces_[k].until) ++k;
  const double before = k == 0 ? 0 : faces_[k - 1].until;
  const Face& face = faces_[k];
  const double own = face.until > before ? (u - before) / (face.until - before) : u;
  return {face.corner + face.u * own + face.v * v - z_ * kOutside, z_};
}

void LightRays::Append(const RayNumbers& numbers, uint32_t begin, uint32_t end,
                       RayBatch& batch) const {
  RandomNumbers8 random;
  for (uint32_t first = begin; first < end; first += 8) {
    numbers.Fill(first, random);
    for (uint32_t lane = 0; lane < std::min<uint32_t>(8, end - first); ++lane) {
      const Ray ray = kind_ == Light::Kind::kDistant
                          ? ThroughBox(random.numbers[2][lane], random.numbers[3][lane])
                          : FromPlace(random.numbers[2][lane], random.numbers[3][lane]);
      batch.Add(ray.origin, ray.direction);
    }
  }
}

}  // namespace lambert

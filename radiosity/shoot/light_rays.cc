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
      cone_(light.cos_inner, light.cos_outer),
      table_(light.table),
      center_(scene.ToTrace(box.Center())),
      radius_(box.Diagonal() / 2 * scene.scale()) {
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

LightRays::Ray LightRays::FromTable(double u, double v) const {
  const SphereTable::Sample sample = table_->Draw(u, v);
  const Vec3 d = sample.direction;
  Ray ray{position_, x_ * d.x + y_ * d.y + z_ * d.z};
  for (int c = 0; c < 3 && weighted(); ++c) {
    const double total = table_->total()[c];
    ray.weight[c] = total > 0 ? sample.value[c] / (sample.density * total) : 0;
  }
  return ray;
}

LightRays::Ray LightRays::FromSky(const float xi[4]) const {
  Ray ray = FromTable(xi[2], xi[3]);
  const Vec3 to_sky = ray.direction;
  // Any two axes across the direction.
  const Vec3 aside = std::fabs(to_sky.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 across = Cross(to_sky, aside);
  const Vec3 u = across / std::sqrt(Dot(across, across)), v = Cross(to_sky, u);
  const SineCosine angle = SinCos(std::numbers::pi * (2.0 * xi[1] - 1));
  const double r = radius_ * std::sqrt(static_cast<double>(xi[0]));
  ray.origin =
      center_ + u * (r * angle.cosine) + v * (r * angle.sine) + to_sky * (radius_ + kOutside);
  ray.direction = -to_sky;
  return ray;
}

LightRays::Ray LightRays::Of(const float xi[4]) const {
  switch (kind_) {
    case Light::Kind::kDistant:
      return ThroughBox(xi[2], xi[3]);
    case Light::Kind::kLamp:
      return FromTable(xi[2], xi[3]);
    case Light::Kind::kSky:
      return FromSky(xi);
    default:
      return FromPlace(xi[2], xi[3]);
  }
}

void LightRays::Append(const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch,
                       Rgb weight[RayBatch::kSlots]) const {
  RandomNumbers8 random;
  for (uint32_t first = begin; first < end; first += 8) {
    numbers.Fill(first, random);
    for (uint32_t lane = 0; lane < std::min<uint32_t>(8, end - first); ++lane) {
      const float xi[4] = {random.numbers[0][lane], random.numbers[1][lane],
                           random.numbers[2][lane], random.numbers[3][lane]};
      const Ray ray = Of(xi);
      weight[batch.size] = ray.weight;
      batch.Add(ray.origin, ray.direction);
    }
  }
}

}  // namespace lambert

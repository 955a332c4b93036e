#include "radiosity/exact/segments.h"

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {

// Powers of 1 / phi_4, where phi_4^5 = phi_4 + 1.
constexpr double kSteps[4] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                              0.5385972572236101};
// Distance of the centres in radii under which weights count as unbounded.
constexpr double kNear = 1.5;

double Area(const Triangle& t) { return 0.5 * Length(Cross(t[1] - t[0], t[2] - t[0])); }

double AreaOf(const Polygon& polygon) {
  double area = 0;
  for (int k = 0; k + 2 < polygon.size; ++k) area += Area(polygon.Part(k));
  return area;
}

// Uniform on the polygon of area `area`.
Vec3 PointOn(const Polygon& polygon, double area, double u, double v) {
  int part = 0;
  if (polygon.size == 4) {
    const double first = Area(polygon.Part(0)) / area;
    part = u < first ? 0 : 1;
    u = part == 0 ? u / first : (u - first) / (1 - first);
  }
  const Triangle t = polygon.Part(part);
  const double root = std::sqrt(std::min(u, 1.0));
  return t[0] + (t[1] - t[0]) * (root * (1 - v)) + (t[2] - t[0]) * (root * v);
}

double Shifted(float shift, int64_t number, int dimension) {
  const double x = shift + static_cast<double>(number) * kSteps[dimension];
  return x - std::floor(x);
}

Vec3 Center(const Polygon& polygon) {
  Vec3 sum;
  for (int k = 0; k < polygon.size; ++k) sum = sum + polygon.corners[k];
  return sum / polygon.size;
}

double Radius(const Polygon& polygon, Vec3 center) {
  double radius = 0;
  for (int k = 0; k < polygon.size; ++k) {
    radius = std::max(radius, Length(polygon.corners[k] - center));
  }
  return radius;
}

}  // namespace

Segments::Segments(const Facing& facing)
    : facing_(facing), from_area_m2_(AreaOf(facing.from)), to_area_m2_(AreaOf(facing.to)) {}

Segments::Segments(const LightFraction& light, const Triangle& to)
    : facing_{{{light.place()}, 1}, {{to[0], to[1], to[2]}, 3}, {}, PlaneOf(to).normal},
      light_(&light),
      to_area_m2_(Area(to)) {}

Segments::Segment Segments::Sample(const std::array<float, 4>& shift, int64_t number) const {
  const auto x = [&](int dimension) { return Shifted(shift[dimension], number, dimension); };
  Segment segment;
  segment.to = PointOn(facing_.to, to_area_m2_, x(2), x(3));
  if (light_ != nullptr) {
    segment.from = light_->SeenFrom(segment.to);
    segment.weight = light_->Density(segment.to, facing_.to_normal) * to_area_m2_;
    return segment;
  }
  segment.from = PointOn(facing_.from, from_area_m2_, x(0), x(1));
  segment.weight = Kernel(segment.from, facing_.from_normal, segment.to, facing_.to_normal) *
                   from_area_m2_ * to_area_m2_;
  return segment;
}

bool Segments::near() const {
  const Vec3 from = Center(facing_.from), to = Center(facing_.to);
  return Length(to - from) < kNear * (Radius(facing_.from, from) + Radius(facing_.to, to));
}

void SegmentTracer::Add(Vec3 from, Vec3 from_normal, Vec3 to, Vec3 to_normal) {
  const Vec3 end = scene_.ToTrace(to) + to_normal * kTieDistance;
  // A light may lie on a wall: it is lifted off towards what it lights, further than a
  // patch's point as that may be at a flat angle.
  const Vec3 lift =
      from_normal == Vec3{} ? Normalized(to - from) * kTieDistance : from_normal * kOriginOffset;
  const Vec3 a = scene_.ToTrace(from) + lift;
  batch_->Add(a, end - a);
}

}  // namespace lambert

#include "radiosity/pyramid/spherical_triangle.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/core/lanes.h"
#include "radiosity/core/sin_cos.h"

namespace lambert {
namespace {

// The unit vector orthogonal to `y` in the plane of `x` and `y`: [x|y] in Arv95.
Vec3 OrthogonalPart(Vec3 x, Vec3 y) { return Normalized(x - Dot(x, y) * y); }

// Angle between the planes (v, p) and (v, q): the interior angle at v.
double AngleAt(Vec3 v, Vec3 p, Vec3 q) {
  const Vec3 m = Cross(v, p), n = Cross(v, q);
  return std::atan2(Length(Cross(m, n)), Dot(m, n));
}

double LambertEdge(Vec3 from, Vec3 to) {
  const Vec3 normal = Cross(from, to);
  const double sine = Length(normal);
  return std::atan2(sine, Dot(from, to)) * normal.z / sine;
}

// ArvoConstants of one triangle, or of one a lane.
template <typename Real>
struct Constants {
  Vector<Real> a, b, c_toward;
  Real sin_alpha, cos_alpha, cos_edge_c, solid_angle;
};

// Arv95, figure 3: the sub-triangle A B C' of area xi1 Omega gives C', then a point on B C'.
template <typename Real>
Vector<Real> Arvo(const Constants<Real>& k, Real xi1, Real xi2) {
  const Real zero = xi1 - xi1, one = zero + 1;
  const SineCosineOf<Real> area = SinCos(xi1 * k.solid_angle);
  const Real s = area.sine * k.cos_alpha - area.cosine * k.sin_alpha;  // sin(A^ - alpha)
  const Real t = area.cosine * k.cos_alpha + area.sine * k.sin_alpha;  // cos(A^ - alpha)
  const Real u = t - k.cos_alpha;
  const Real v = s + k.sin_alpha * k.cos_edge_c;
  const Real denominator = (v * s + u * t) * k.sin_alpha;
  // xi1 = 0 makes the sub-triangle vanish: C' is A.
  const Real ratio =
      ((v * t - u * s) * k.cos_alpha - v) / (denominator == zero ? one : denominator);
  const Real low = ratio < -one ? -one : ratio;
  const Real q = denominator == zero ? one : low > one ? one : low;
  const Real across = 1 - q * q;
  const Vector<Real> c_sub = q * k.a + Root(across > zero ? across : zero) * k.c_toward;
  const Real to_b = Dot(c_sub, k.b);
  const Real z = 1 - xi2 * (1 - to_b);
  const Vector<Real> toward = c_sub - to_b * k.b;
  const Real length2 = Dot(toward, toward), beside = 1 - z * z;
  // C' = B leaves no direction to go: the point is B.
  const Real reach = (beside > zero ? beside : zero) / (length2 > zero ? length2 : one);
  const Real along = length2 > zero ? z : one;
  return along * k.b + Root(length2 > zero ? reach : zero) * toward;
}

Vector<double> ToVector(Vec3 v) { return {v.x, v.y, v.z}; }

}  // namespace

double FluxFraction(Vec3 a, Vec3 b, Vec3 c) {
  return (LambertEdge(a, b) + LambertEdge(b, c) + LambertEdge(c, a)) / (2 * std::numbers::pi);
}

ArvoConstants MakeArvoConstants(Vec3 a, Vec3 b, Vec3 c) {
  const double alpha = AngleAt(a, b, c);
  ArvoConstants triangle;
  triangle.a = a;
  triangle.b = b;
  triangle.c_toward = OrthogonalPart(c, a);
  triangle.sin_alpha = std::sin(alpha);
  triangle.cos_alpha = std::cos(alpha);
  triangle.cos_edge_c = Dot(a, b);
  triangle.solid_angle = alpha + AngleAt(b, c, a) + AngleAt(c, a, b) - std::numbers::pi;
  return triangle;
}

SphericalTriangle::SphericalTriangle(Vec3 a, Vec3 b, Vec3 c)
    : arvo_(MakeArvoConstants(a, b, c)),
      c_(c),
      flux_fraction_(FluxFraction(a, b, c)),
      pieces_(CutOnDisk(a, b, c)) {}

const DiskPiece& SphericalTriangle::PickOneOfMany(float& xi) const {
  const auto after = std::upper_bound(pieces_.begin(), pieces_.end() - 1, xi,
                                      [](float x, const DiskPiece& p) { return x < p.until; });
  const float from = after == pieces_.begin() ? 0 : (after - 1)->until;
  xi = std::clamp((xi - from) / (after->until - from), 0.0f, 1 - 0x1p-24f);
  return *after;
}

Vec3 SampleSolidAngle(const ArvoConstants& k, double xi1, double xi2) {
  const Vector<double> d = Arvo<double>({ToVector(k.a), ToVector(k.b), ToVector(k.c_toward),
                                         k.sin_alpha, k.cos_alpha, k.cos_edge_c, k.solid_angle},
                                        xi1, xi2);
  return {d.x, d.y, d.z};
}

void SampleSolidAngle8(const SphericalTriangle* const triangles[8], const float xi1[8],
                       const float xi2[8], Directions8& out) {
  for (int first = 0; first < 8; first += 4) {
    const ArvoConstants* k[4];
    for (int lane = 0; lane < 4; ++lane) k[lane] = &triangles[first + lane]->arvo();
    const auto gather = [&](auto get) {
      return Double4{get(*k[0]), get(*k[1]), get(*k[2]), get(*k[3])};
    };
    const auto gather3 = [&](Vec3 ArvoConstants::*member) {
      return Vector<Double4>{gather([&](const ArvoConstants& c) { return (c.*member).x; }),
                             gather([&](const ArvoConstants& c) { return (c.*member).y; }),
                             gather([&](const ArvoConstants& c) { return (c.*member).z; })};
    };
    const auto gather1 = [&](double ArvoConstants::*member) {
      return gather([&](const ArvoConstants& c) { return c.*member; });
    };
    const Constants<Double4> constants{
        gather3(&ArvoConstants::a),          gather3(&ArvoConstants::b),
        gather3(&ArvoConstants::c_toward),   gather1(&ArvoConstants::sin_alpha),
        gather1(&ArvoConstants::cos_alpha),  gather1(&ArvoConstants::cos_edge_c),
        gather1(&ArvoConstants::solid_angle)};
    const Vector<Double4> d = Arvo<Double4>(constants, _mm256_cvtps_pd(_mm_load_ps(xi1 + first)),
                                            _mm256_cvtps_pd(_mm_load_ps(xi2 + first)));
    _mm256_store_pd(out.x + first, d.x);
    _mm256_store_pd(out.y + first, d.y);
    _mm256_store_pd(out.z + first, d.z);
  }
}

}  // namespace lambert

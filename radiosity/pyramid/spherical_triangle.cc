#include "radiosity/pyramid/spherical_triangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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

// Largest z on the great-circle arc between two unit vectors.
double HighestOnArc(Vec3 p, Vec3 q) {
  const Vec3 normal = Normalized(Cross(p, q));
  // The highest point of the circle; it counts where it lies between p and q.
  const Vec3 top = Vec3{0, 0, 1} - normal.z * normal;
  if (Dot(Cross(p, top), normal) > 0 && Dot(Cross(top, q), normal) > 0) return Length(top);
  return std::max(p.z, q.z);
}

}  // namespace

SineCosine SinCos(double x) {
  // Taylor series of an eighth of the angle, doubled three times.
  const double t = x * 0.125, t2 = t * t;
  double s =
      t * (1 + t2 * (-1.0 / 6 +
                     t2 * (1.0 / 120 + t2 * (-1.0 / 5040 + t2 * (1.0 / 362880 - t2 / 39916800)))));
  double c =
      1 + t2 * (-0.5 +
                t2 * (1.0 / 24 + t2 * (-1.0 / 720 + t2 * (1.0 / 40320 -
                                                          t2 * (1.0 / 3628800 - t2 / 479001600)))));
  for (int doubling = 0; doubling < 3; ++doubling) {
    const double sine = 2 * s * c;
    c = (c - s) * (c + s);
    s = sine;
  }
  return {s, c};
}

SphericalTriangle::SphericalTriangle(Vec3 a, Vec3 b, Vec3 c) : a_(a), b_(b), c_(c) {
  const double alpha = AngleAt(a, b, c);
  solid_angle_ = alpha + AngleAt(b, c, a) + AngleAt(c, a, b) - std::numbers::pi;
  sin_alpha_ = std::sin(alpha);
  cos_alpha_ = std::cos(alpha);
  cos_edge_c_ = Dot(a, b);
  c_toward_ = OrthogonalPart(c, a);
  flux_fraction_ =
      (LambertEdge(a, b) + LambertEdge(b, c) + LambertEdge(c, a)) / (2 * std::numbers::pi);
  const bool holds_pole = Cross(a, b).z >= 0 && Cross(b, c).z >= 0 && Cross(c, a).z >= 0;
  max_cosine_ =
      holds_pole
          ? 1.0
          : std::min(1.0, std::max({HighestOnArc(a, b), HighestOnArc(b, c), HighestOnArc(c, a)}));
}

Vec3 SphericalTriangle::SampleSolidAngle(double xi1, double xi2) const {
  // Arv95, figure 3: the sub-triangle A B C' of area xi1 Omega gives C', then a point on B C'.
  const SineCosine area = SinCos(xi1 * solid_angle_);
  const double s = area.sine * cos_alpha_ - area.cosine * sin_alpha_;  // sin(A^ - alpha)
  const double t = area.cosine * cos_alpha_ + area.sine * sin_alpha_;  // cos(A^ - alpha)
  const double u = t - cos_alpha_;
  const double v = s + sin_alpha_ * cos_edge_c_;
  const double denominator = (v * s + u * t) * sin_alpha_;
  // xi1 = 0 makes the sub-triangle vanish: C' is A.
  const double q = denominator == 0
                       ? 1.0
                       : std::clamp(((v * t - u * s) * cos_alpha_ - v) / denominator, -1.0, 1.0);
  const Vec3 c_sub = q * a_ + std::sqrt(std::max(0.0, 1 - q * q)) * c_toward_;
  const double z = 1 - xi2 * (1 - Dot(c_sub, b_));
  const Vec3 toward = c_sub - Dot(c_sub, b_) * b_;
  const double length2 = Dot(toward, toward);
  if (length2 <= 0) return b_;
  return z * b_ + std::sqrt(std::max(0.0, 1 - z * z) / length2) * toward;
}

}  // namespace lambert

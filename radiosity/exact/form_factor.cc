#include "radiosity/exact/form_factor.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/exact/edge_integral.h"

namespace lambert {
namespace {

// Sum of the radii over the distance, under which areas are integrated: the contour sum loses about
// 1e-16 / ratio^3 to cancellation, the rule of degree 5 about ratio^6.
constexpr double kFarRatio = 0.015;

struct Ball {
  Vec3 center;
  double radius = 0;
};

Ball BallOf(const Polygon& polygon) {
  Ball ball;
  for (int k = 0; k < polygon.size; ++k) ball.center = ball.center + polygon.corners[k];
  ball.center = ball.center / polygon.size;
  for (int k = 0; k < polygon.size; ++k) {
    ball.radius = std::max(ball.radius, Length(polygon.corners[k] - ball.center));
  }
  return ball;
}

// Radon's rule of seven points and degree 5: barycentric weights of two corners, and the weight.
struct TrianglePoint {
  double b0, b1, weight;
};
constexpr double kRoot15 = 3.8729833462074168852;
constexpr double kInner = (6 - kRoot15) / 21, kOuter = (6 + kRoot15) / 21;
constexpr double kInnerWeight = (155 - kRoot15) / 1200, kOuterWeight = (155 + kRoot15) / 1200;
constexpr TrianglePoint kRadon[] = {
    {1.0 / 3, 1.0 / 3, 9.0 / 40},           {kInner, kInner, kInnerWeight},
    {kInner, 1 - 2 * kInner, kInnerWeight}, {1 - 2 * kInner, kInner, kInnerWeight},
    {kOuter, kOuter, kOuterWeight},         {kOuter, 1 - 2 * kOuter, kOuterWeight},
    {1 - 2 * kOuter, kOuter, kOuterWeight}};

Vec3 At(const Triangle& t, const TrianglePoint& p) {
  return t[2] + (t[0] - t[2]) * p.b0 + (t[1] - t[2]) * p.b1;
}

double FarTriangles(const Triangle& a, Vec3 a_normal, const Triangle& b, Vec3 b_normal) {
  double sum = 0;
  for (const TrianglePoint& p : kRadon) {
    const Vec3 x = At(a, p);
    for (const TrianglePoint& q : kRadon) {
      sum += p.weight * q.weight * Kernel(x, a_normal, At(b, q), b_normal);
    }
  }
  const double areas =
      0.25 * Length(Cross(a[1] - a[0], a[2] - a[0])) * Length(Cross(b[1] - b[0], b[2] - b[0]));
  return sum * areas;
}

double FarExchange(const Facing& f) {
  double sum = 0;
  for (int i = 0; i + 2 < f.from.size; ++i) {
    for (int j = 0; j + 2 < f.to.size; ++j) {
      sum += FarTriangles(f.from.Part(i), f.from_normal, f.to.Part(j), f.to_normal);
    }
  }
  return sum;
}

struct Contour {
  std::array<Edge, 4> edges;
  int size = 0;
};

// The edges in coordinates whose unit is `unit`: ln r is then near 0, and adds to 0 around a
// contour without loss.
Contour ContourOf(const Polygon& polygon, Vec3 origin, double unit) {
  Contour contour;
  for (int k = 0; k < polygon.size; ++k) {
    const Vec3 from = (polygon.corners[k] - origin) / unit;
    const Vec3 to = (polygon.corners[(k + 1) % polygon.size] - origin) / unit;
    if (!(from == to)) contour.edges[contour.size++] = EdgeBetween(from, to);
  }
  return contour;
}

}  // namespace

Facing FacingParts(const Triangle& from, const Triangle& to) {
  const Plane from_plane = PlaneOf(from), to_plane = PlaneOf(to);
  Facing facing{ClipToFront(from, to_plane), {}, from_plane.normal, to_plane.normal};
  if (facing.empty()) return facing;
  facing.to = ClipToFront(to, from_plane);
  if (facing.to.size == 0) facing.from.size = 0;
  return facing;
}

double ExchangeArea(const Facing& facing) {
  if (facing.empty()) return 0;
  const Ball from = BallOf(facing.from), to = BallOf(facing.to);
  const double distance = Length(to.center - from.center);
  if (from.radius + to.radius < kFarRatio * distance) return FarExchange(facing);
  // The outer integral goes over the smaller contour, the closed form over the larger.
  const bool swap = to.radius < from.radius;
  const Vec3 origin = swap ? to.center : from.center;
  const double unit = std::max({distance, from.radius, to.radius});
  const Contour outer = ContourOf(swap ? facing.to : facing.from, origin, unit);
  const Contour inner = ContourOf(swap ? facing.from : facing.to, origin, unit);
  double sum = 0;
  for (int i = 0; i < outer.size; ++i) {
    const Edge& p = outer.edges[i];
    for (int j = 0; j < inner.size; ++j) {
      const Edge& q = inner.edges[j];
      const double cosine = Dot(p.direction, q.direction);
      if (cosine != 0) sum += cosine * LogDistanceIntegral(p, q);
    }
  }
  return std::max(0.0, sum * unit * unit / (2 * std::numbers::pi));
}

double Kernel(Vec3 from, Vec3 from_normal, Vec3 to, Vec3 to_normal) {
  const Vec3 r = to - from;
  const double r2 = Dot(r, r);
  return -Dot(from_normal, r) * Dot(to_normal, r) / (std::numbers::pi * r2 * r2);
}

double SolidAngleFrom(Vec3 point, const Triangle& triangle) {
  const Vec3 a = triangle[0] - point, b = triangle[1] - point, c = triangle[2] - point;
  const double la = Length(a), lb = Length(b), lc = Length(c);
  const double volume = -Dot(a, Cross(b, c));  // > 0 in front
  if (!(volume > 0)) return 0;
  return 2 * std::atan2(volume, la * lb * lc + Dot(a, b) * lc + Dot(b, c) * la + Dot(c, a) * lb);
}

}  // namespace lambert

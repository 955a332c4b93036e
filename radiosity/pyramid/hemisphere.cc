#include "radiosity/pyramid/hemisphere.h"

#include <cmath>
#include <numbers>

namespace lambert {
namespace {

// Normal of the plane through p and q, on the side of `inside`.
Vec3 PlaneToward(Vec3 p, Vec3 q, Vec3 inside) {
  const Vec3 normal = Normalized(Cross(p, q));
  return Dot(normal, inside) >= 0 ? normal : -normal;
}

}  // namespace

Hemisphere::Hemisphere(int initial, int split, int depth)
    : initial_(initial), split_(split), depth_(depth), divisions_(depth), levels_(depth + 1) {
  for (int k = 0; k < initial; ++k) {
    const double angle = 2 * std::numbers::pi * k / initial;
    horizon_.push_back({std::cos(angle), std::sin(angle), 0});
  }
  for (int k = 0; k < initial; ++k) {
    Divide({0, 0, 1}, horizon_[k], horizon_[(k + 1) % initial], depth);
  }
}

void Hemisphere::Divide(Vec3 a, Vec3 b, Vec3 c, int depth) {
  levels_[depth_ - depth].emplace_back(a, b, c);
  if (depth == 0) {
    sides_.push_back({{PlaneToward(a, b, c), PlaneToward(b, c, a), PlaneToward(c, a, b)}});
    return;
  }
  std::vector<Division>& level = divisions_[depth_ - depth];
  if (split_ == 4) {
    const Vec3 ab = Normalized(a + b), bc = Normalized(b + c), ca = Normalized(c + a);
    level.push_back({{PlaneToward(ab, ca, a), PlaneToward(bc, ab, b), PlaneToward(ca, bc, c)}});
    Divide(a, ab, ca, depth - 1);
    Divide(ab, b, bc, depth - 1);
    Divide(ca, bc, c, depth - 1);
    Divide(ab, bc, ca, depth - 1);
    return;
  }
  const Vec3 m = Normalized(a + b + c);
  // Each plane holds the centroid and a vertex, its normal turned counter-clockwise around m.
  level.push_back({{Normalized(Cross(m, a)), Normalized(Cross(m, b)), Normalized(Cross(m, c))}});
  Divide(a, b, m, depth - 1);
  Divide(b, c, m, depth - 1);
  Divide(c, a, m, depth - 1);
}

int Hemisphere::Locate(Vec3 d) const {
  if (!(d.z >= 0)) return -1;
  int node = initial_ - 1;
  for (int k = 0; k + 1 < initial_; ++k) {
    const Vec3 &from = horizon_[k], &to = horizon_[k + 1];
    if (from.x * d.y - from.y * d.x >= 0 && to.x * d.y - to.y * d.x < 0) {
      node = k;
      break;
    }
  }
  for (const std::vector<Division>& level : divisions_) {
    const Division& division = level[node];
    const double s0 = Dot(division.plane[0], d);
    const double s1 = Dot(division.plane[1], d);
    const double s2 = Dot(division.plane[2], d);
    int child;
    if (split_ == 4) {
      child = s0 > 0 ? 0 : s1 > 0 ? 1 : s2 > 0 ? 2 : 3;
    } else {
      child = s0 >= 0 && s1 < 0 ? 0 : s1 >= 0 && s2 < 0 ? 1 : 2;
    }
    node = node * split_ + child;
  }
  return node;
}

bool Hemisphere::HoldsBall(int p, Vec3 center, double radius) const {
  const double margin =
      radius + 1e-9 * (radius + std::abs(center.z) + std::abs(center.x) + std::abs(center.y));
  for (const Vec3& side : sides_[p].plane) {
    if (Dot(side, center) < margin) return false;
  }
  return true;
}

}  // namespace lambert

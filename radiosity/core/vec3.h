// Three-component vectors in double precision. Values; no state; any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace lambert {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  bool operator==(const Vec3&) const = default;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(double s, Vec3 a) { return a * s; }
inline Vec3 operator/(Vec3 a, double s) { return {a.x / s, a.y / s, a.z / s}; }

inline double Dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 Cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Euclidean length, without overflow or underflow for finite components.
inline double Length(Vec3 a) { return std::hypot(a.x, a.y, a.z); }
// Requires: a is not zero.
inline Vec3 Normalized(Vec3 a) { return a / Length(a); }
inline bool IsFinite(Vec3 a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// From and to float32, as vertices and rays are stored.
inline Vec3 FromFloats(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }
inline std::array<float, 3> ToFloats(Vec3 a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
inline void ToFloats(Vec3 a, float to[3]) { std::ranges::copy(ToFloats(a), to); }

}  // namespace lambert

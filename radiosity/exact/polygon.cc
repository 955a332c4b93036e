#include "radiosity/exact/polygon.h"

#include <algorithm>
#include <cmath>

namespace lambert {
namespace {

constexpr double kInPlane = 1e-12;  // rounding of a height, as a fraction of the lengths in it

}  // namespace

Plane PlaneOf(const Triangle& triangle) {
  const Vec3 normal = Normalized(Cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
  return {normal, Dot(normal, triangle[0])};
}

Polygon ClipToFront(const Triangle& triangle, const Plane& plane) {
  std::array<double, 3> height;
  for (int k = 0; k < 3; ++k) {
    height[k] = plane.Height(triangle[k]);
    const double extent = std::fabs(plane.offset) + Length(triangle[k]);
    if (std::fabs(height[k]) <= kInPlane * extent) height[k] = 0;
  }
  Polygon part;
  if (std::max({height[0], height[1], height[2]}) <= 0) return part;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (height[k] >= 0) part.corners[part.size++] = triangle[k];
    if (height[k] * height[next] < 0) {
      const double t = height[k] / (height[k] - height[next]);
      part.corners[part.size++] = triangle[k] + (triangle[next] - triangle[k]) * t;
    }
  }
  return part;
}

}  // namespace lambert

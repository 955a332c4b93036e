// Triangles as other triangles see them: what stands in front of a plane.
#pragma once

#include <array>

#include "radiosity/core/vec3.h"

namespace lambert {

using Triangle = std::array<Vec3, 3>;  // counter-clockwise seen from its front

// Points p with Dot(normal, p) > offset are in front.
struct Plane {
  Vec3 normal;  // unit
  double offset = 0;
  double Height(Vec3 p) const { return Dot(normal, p) - offset; }
};
// Requires: a triangle of area > 0.
Plane PlaneOf(const Triangle& triangle);

// A flat convex polygon: a triangle of which a plane has cut a corner off, or none, or two.
struct Polygon {
  std::array<Vec3, 4> corners;
  int size = 0;  // 0: nothing, 3 or 4
  // The triangles 0, k + 1, k + 2 with k = 0 .. size - 3 make it up.
  Triangle Part(int k) const { return {corners[0], corners[k + 1], corners[k + 2]}; }
};

// The part of a triangle in front of a plane; corners that it keeps stay bit for bit. Corners
// within 1e-12 of the triangle's and the plane's extent count as lying in the plane, and a triangle
// that reaches no further has nothing in front.
Polygon ClipToFront(const Triangle& triangle, const Plane& plane);

}  // namespace lambert

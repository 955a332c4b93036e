// Form factors in closed form: of two triangles, and of a triangle seen from a point.
//
// A_i F_ij is symmetric: the exchange area of i and j [m2]. Sides are one-sided; only what stands
// in front of both planes counts, so what is behind is cut off first. Nothing occludes here.
#pragma once

#include "radiosity/exact/polygon.h"

namespace lambert {

// What two triangles show each other.
struct Facing {
  Polygon from, to;  // both of size 0 where they do not see each other
  Vec3 from_normal, to_normal;
  bool empty() const { return from.size == 0; }
};
// Requires: triangles of area > 0.
Facing FacingParts(const Triangle& from, const Triangle& to);

// Exchange area of the facing parts [m2], >= 0, to about 1e-11 of itself (1e-9 where one triangle
// is a million times as long as the other). With r between points of both contours (Spa63):
//   A_i F_ij = 1/(2 pi) sum over edges p of i, q of j of (p . q) integral integral ln r ds dt
// Far from each other, where the sum cancels, the kernel is integrated over both areas instead.
double ExchangeArea(const Facing& facing);
inline double ExchangeArea(const Triangle& from, const Triangle& to) {
  return ExchangeArea(FacingParts(from, to));
}

// cos theta_i cos theta_j / (pi r^2) between a point of either part [1/m2].
double Kernel(Vec3 from, Vec3 from_normal, Vec3 to, Vec3 to_normal);

// Solid angle of a triangle's front from a point [sr], 0 from behind (VOS83).
double SolidAngleFrom(Vec3 point, const Triangle& triangle);

}  // namespace lambert

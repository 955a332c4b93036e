// A triangle on the unit hemisphere around +z, the base of one pyramid.
#pragma once

#include "radiosity/core/vec3.h"

namespace lambert {

// Sine and cosine without libm, equal to the last bit on every machine; error under 1e-14.
// Requires: |x| <= pi.
struct SineCosine {
  double sine = 0, cosine = 1;
};
SineCosine SinCos(double x);

class SphericalTriangle {
 public:
  // Requires: unit vectors with z >= 0, counter-clockwise seen from outside the sphere, no two
  // equal, the triangle smaller than a hemisphere.
  SphericalTriangle(Vec3 a, Vec3 b, Vec3 c);

  Vec3 a() const { return a_; }
  Vec3 b() const { return b_; }
  Vec3 c() const { return c_; }
  // Omega [sr], by Girard's formula.
  double solid_angle() const { return solid_angle_; }
  // f_p: the fraction of a Lambertian emitter's flux that leaves through the triangle, by Lambert's
  // polygon formula:  f = 1/(2 pi) sum_k gamma_k (n . Gamma_k)
  // gamma_k: angle of edge k; Gamma_k: unit normal of its plane.
  double flux_fraction() const { return flux_fraction_; }
  // Largest z (cosine to the normal) of any direction in the triangle.
  double max_cosine() const { return max_cosine_; }

  // Direction with uniform density in solid angle (Arv95). xi1, xi2 in [0, 1).
  Vec3 SampleSolidAngle(double xi1, double xi2) const;

 private:
  Vec3 a_, b_, c_;
  Vec3 c_toward_;  // [C|A]: the unit vector orthogonal to A in the plane of A and C
  double sin_alpha_ = 0, cos_alpha_ = 0;  // angle at A
  double cos_edge_c_ = 0;                 // A . B
  double solid_angle_ = 0, flux_fraction_ = 0, max_cosine_ = 0;
};

}  // namespace lambert

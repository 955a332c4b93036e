// A triangle on the unit hemisphere around +z, the base of one pyramid.
#pragma once

#include <vector>

#include "radiosity/core/vec3.h"
#include "radiosity/pyramid/disk_piece.h"

namespace lambert {

// What sampling a triangle A B C needs (Arv95).
struct ArvoConstants {
  Vec3 a, b;
  Vec3 c_toward;                        // [C|A]: unit, orthogonal to A, in the plane of A and C
  double sin_alpha = 0, cos_alpha = 0;  // angle at A
  double cos_edge_c = 0;                // A . B
  double solid_angle = 0;               // [sr]
};

// Requires: unit vectors, no two equal, the triangle smaller than a hemisphere.
ArvoConstants MakeArvoConstants(Vec3 a, Vec3 b, Vec3 c);
// A direction in that triangle with uniform density in solid angle. xi1, xi2 in [0, 1).
Vec3 SampleSolidAngle(const ArvoConstants& triangle, double xi1, double xi2);

// f: the fraction of a Lambertian emitter's flux that leaves through a triangle, by Lambert's
// polygon formula:  f = 1/(2 pi) sum_k gamma_k (n . Gamma_k) gamma_k: angle of edge k; Gamma_k:
// unit normal of its plane.
double FluxFraction(Vec3 a, Vec3 b, Vec3 c);

class SphericalTriangle {
 public:
  // Requires: unit vectors with z >= 0, counter-clockwise seen from outside the sphere, no two
  // equal, the triangle smaller than a hemisphere.
  SphericalTriangle(Vec3 a, Vec3 b, Vec3 c);

  Vec3 a() const { return arvo_.a; }
  Vec3 b() const { return arvo_.b; }
  Vec3 c() const { return c_; }
  // Omega [sr], by Girard's formula.
  double solid_angle() const { return arvo_.solid_angle; }
  // f_p = FluxFraction of its corners.
  double flux_fraction() const { return flux_fraction_; }

  // For directions with density ~ cos theta: the piece where a number xi in [0, 1) lies, and where
  // it lies there.
  const DiskPiece& PickPiece(float& xi) const {
    return pieces_.size() == 1 ? pieces_[0] : PickOneOfMany(xi);
  }
  // Direction with uniform density in solid angle (Arv95). xi1, xi2 in [0, 1).
  Vec3 SampleSolidAngle(double xi1, double xi2) const {
    return lambert::SampleSolidAngle(arvo_, xi1, xi2);
  }
  const ArvoConstants& arvo() const { return arvo_; }

 private:
  const DiskPiece& PickOneOfMany(float& xi) const;

  ArvoConstants arvo_;
  Vec3 c_;
  double flux_fraction_ = 0;
  std::vector<DiskPiece> pieces_;
};

// Eight directions, one a lane.
struct alignas(64) Directions8 {
  double x[8], y[8], z[8];
};

// triangles[l]->SampleSolidAngle(xi1[l], xi2[l]) for each lane l, to the last bit, at once.
// Requires: xi1, xi2 aligned to 16 bytes.
void SampleSolidAngle8(const SphericalTriangle* const triangles[8], const float xi1[8],
                       const float xi2[8], Directions8& out);

}  // namespace lambert

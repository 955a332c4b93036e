// Spherical triangles cut into bins, with areas and fluxes by formulas that the library does not
// use.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "radiosity/core/vec3.h"
#include "radiosity/pyramid/spherical_triangle.h"

namespace lambert {

// Solid angle [sr] of the triangle of three unit vectors (Van Oosterom, Strackee 1983):
//   tan(Omega / 2) = a . (b x c) / (1 + a . b + b . c + c . a)
inline double SolidAngle(Vec3 a, Vec3 b, Vec3 c) {
  return 2 * std::atan2(Dot(a, Cross(b, c)), 1 + Dot(a, b) + Dot(b, c) + Dot(c, a));
}

// A spherical triangle and its sides, whose unit normals point inward.
struct SphereBin {
  Vec3 a, b, c;
  Vec3 side[3];

  SphereBin(Vec3 a, Vec3 b, Vec3 c)
      : a(a),
        b(b),
        c(c),
        side{Normalized(Cross(a, b)), Normalized(Cross(b, c)), Normalized(Cross(c, a))} {}
  explicit SphereBin(const SphericalTriangle& t) : SphereBin(t.a(), t.b(), t.c()) {}

  // How far `d` is inside, negative outside.
  double Inside(Vec3 d) const {
    return std::min({Dot(side[0], d), Dot(side[1], d), Dot(side[2], d)});
  }
};

// A triangle cut `depth` times into four by the midpoints of its edges: 4^depth bins.
class SphereBins {
 public:
  SphereBins(const SphericalTriangle& t, int depth) { Cut(t.a(), t.b(), t.c(), depth); }

  int size() const { return static_cast<int>(bins_.size()); }
  // The bin of a direction; on a border, or outside by rounding, a near one.
  int Find(Vec3 d) const {
    const auto nearer = [&](const SphereBin& x, const SphereBin& y) {
      return x.Inside(d) < y.Inside(d);
    };
    return static_cast<int>(std::max_element(bins_.begin(), bins_.end(), nearer) - bins_.begin());
  }

  // Shares of the triangle's solid angle.
  std::vector<double> SolidAngleShares() const { return Shares(SolidAngle); }
  // Shares of the flux of a Lambertian emitter whose normal is z.
  std::vector<double> FluxShares() const { return Shares(FluxFraction); }

  // 1/pi integral cos theta d omega: each piece counts as its solid angle at its centroid. The
  // error of that is a series in the square of a piece's edge, so two depths give the limit
  // (Richardson).
  static double FluxFraction(Vec3 a, Vec3 b, Vec3 c) {
    const double coarse = Flux(a, b, c, 4), fine = Flux(a, b, c, 5);
    return (fine + (fine - coarse) / 3) / std::numbers::pi;
  }

 private:
  void Cut(Vec3 a, Vec3 b, Vec3 c, int depth) {
    if (depth == 0) {
      bins_.push_back({a, b, c});
      return;
    }
    const Vec3 ab = Normalized(a + b), bc = Normalized(b + c), ca = Normalized(c + a);
    Cut(a, ab, ca, depth - 1);
    Cut(ab, b, bc, depth - 1);
    Cut(ca, bc, c, depth - 1);
    Cut(ab, bc, ca, depth - 1);
  }

  static double Flux(Vec3 a, Vec3 b, Vec3 c, int depth) {
    if (depth == 0) return Normalized(a + b + c).z * SolidAngle(a, b, c);
    const Vec3 ab = Normalized(a + b), bc = Normalized(b + c), ca = Normalized(c + a);
    return Flux(a, ab, ca, depth - 1) + Flux(ab, b, bc, depth - 1) + Flux(ca, bc, c, depth - 1) +
           Flux(ab, bc, ca, depth - 1);
  }

  std::vector<double> Shares(double (*measure)(Vec3, Vec3, Vec3)) const {
    std::vector<double> shares;
    double sum = 0;
    for (const SphereBin& bin : bins_) sum += shares.emplace_back(measure(bin.a, bin.b, bin.c));
    for (double& share : shares) share /= sum;
    return shares;
  }

  std::vector<SphereBin> bins_;
};

}  // namespace lambert

// Directions with density ~ cos theta inside a spherical triangle: directions above the horizon are
// the points (x, y) of the unit disk, where that density is uniform.
#pragma once

#include <vector>

#include "radiosity/core/lanes.h"
#include "radiosity/core/vec3.h"

namespace lambert {

// A part of a spherical triangle, and a flat triangle that holds its image on the disk: of points
// that are uniform there, those whose directions lie inside all sides are taken. One cache line.
struct alignas(64) DiskPiece {
  float corner[2], edge1[2], edge2[2];
  float side[3][3];  // inward unit normals of the sides
  float until = 1;   // fraction of the whole triangle's flux in this piece and those before
};

// Parts that share a triangle, each of which takes at least kLeastTaken of the points. Those of
// compact triangles are one; long ones along the horizon, whose images are crescents, are cut by
// their longest edges. Their cusps, each under kCuspFlux of the triangle's flux, may take fewer.
// Requires: as for SphericalTriangle.
inline constexpr double kLeastTaken = 0.4, kCuspFlux = 1e-4;
std::vector<DiskPiece> CutOnDisk(Vec3 a, Vec3 b, Vec3 c);

struct DiskTrial {
  Vector<Float8> direction;  // unit vectors
  Int8 inside;               // true where it is taken
};

// Eight pieces, lane by lane.
class DiskPiece8 {
 public:
  explicit DiskPiece8(const DiskPiece* const pieces[8]) {
    const float* rows[8];
    for (int lane = 0; lane < 8; ++lane) rows[lane] = reinterpret_cast<const float*>(pieces[lane]);
    LoadColumns16(rows, columns_);
  }

  // One point for each lane. u, v in [0, 1).
  DiskTrial Try(Float8 u, Float8 v) const {
    const Float8* c = columns_;
    const Float8 root = Root(u), b1 = root * (1 - v), b2 = root * v;
    const Float8 x = c[0] + b1 * c[2] + b2 * c[4], y = c[1] + b1 * c[3] + b2 * c[5];
    const Float8 left = 1 - x * x - y * y;
    DiskTrial trial{{x, y, Root(left > 0 ? left : Float8{})}, left >= 0};
    for (int k = 6; k < 15; k += 3) {
      trial.inside &= Dot(trial.direction, {c[k], c[k + 1], c[k + 2]}) >= 0;
    }
    return trial;
  }

 private:
  Float8 columns_[16];
};

}  // namespace lambert

// A hemisphere around +z cut into spherical triangles: the pyramids of JPS00, section 3.2, in the
// local frame of a patch (x, y in its plane, z along its normal). The same for every patch.
#pragma once

#include <vector>

#include "radiosity/core/vec3.h"
#include "radiosity/pyramid/spherical_triangle.h"

namespace lambert {

class Hemisphere {
 public:
  // `initial` equal triangles between the pole and the horizon, each split `depth` times into
  // `split` parts: 4 by its edges' midpoints, 3 by its centroid (figure 4).
  // Requires: initial >= 3, split 3 or 4, depth >= 0.
  Hemisphere(int initial, int split, int depth);

  int size() const { return static_cast<int>(pyramids_.size()); }
  const SphericalTriangle& pyramid(int p) const { return pyramids_[p]; }

  // The pyramid that holds a direction (of any length > 0), or -1 below the horizon. Every
  // direction above the horizon is in exactly one.
  int Locate(Vec3 direction) const;

  // True if the ball around `center` is wholly inside pyramid p, with a margin for rounding.
  bool HoldsBall(int p, Vec3 center, double radius) const;

 private:
  // How a triangle is divided: three planes, tested in order.
  struct Division {
    Vec3 plane[3];
  };
  void Divide(Vec3 a, Vec3 b, Vec3 c, int depth);

  int initial_, split_, depth_;
  std::vector<Vec3> horizon_;                     // where the initial triangles meet it
  std::vector<std::vector<Division>> divisions_;  // by level, then by triangle of that level
  std::vector<SphericalTriangle> pyramids_;
  std::vector<Division> sides_;  // inward unit normals of each pyramid's sides
};

}  // namespace lambert

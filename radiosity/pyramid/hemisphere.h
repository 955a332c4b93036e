// A hemisphere cut into spherical triangles: the pyramids of JPS00, section 3.2.
#pragma once

#include <vector>

#include "radiosity/pyramid/cells.h"
#include "radiosity/pyramid/spherical_triangle.h"

namespace lambert {

class Hemisphere : public HemisphereCells {
 public:
  // `initial` equal triangles between the pole and the horizon, each split `depth` times into
  // `split` parts: 4 by its edges' midpoints, 3 by its centroid (figure 4). Children of triangle k
  // of one level: triangles k * split .. k * split + split - 1 of the next.
  // Requires: initial >= 3, split 3 or 4, depth >= 0.
  Hemisphere(int initial, int split, int depth);

  int depth() const { return depth_; }
  int split() const { return split_; }
  int size() const override { return static_cast<int>(levels_.back().size()); }
  const SphericalTriangle& pyramid(int p) const { return levels_.back()[p]; }
  // The triangles after `level` splits, 0 <= level <= depth().
  const std::vector<SphericalTriangle>& level(int level) const { return levels_[level]; }

  double flux_fraction(int p) const override { return pyramid(p).flux_fraction(); }
  int Locate(Vec3 direction) const override;
  // Tested with a margin for rounding.
  bool HoldsBall(int p, Vec3 center, double radius) const override;

 private:
  // How a triangle is divided: three planes, tested in order.
  struct Division {
    Vec3 plane[3];
  };
  void Divide(Vec3 a, Vec3 b, Vec3 c, int depth);

  int initial_, split_, depth_;
  std::vector<Vec3> horizon_;                     // where the initial triangles meet it
  std::vector<std::vector<Division>> divisions_;  // by level, then by triangle of that level
  std::vector<std::vector<SphericalTriangle>> levels_;
  std::vector<Division> sides_;  // inward unit normals of each pyramid's sides
};

}  // namespace lambert

// A hemisphere cut into squares of the concentric map: cells of equal projected solid angle.
#pragma once

#include "radiosity/pyramid/cells.h"

namespace lambert {

// `side` by `side` squares of the unit square, mapped to the unit disk (SC97) and lifted to the
// hemisphere. Cell y * side + x: the squares x / side .. (x + 1) / side, and so for y.
class ConcentricGrid : public HemisphereCells {
 public:
  // Requires: side >= 1.
  explicit ConcentricGrid(int side) : side_(side) {}

  int side() const { return side_; }
  int size() const override { return side_ * side_; }
  double flux_fraction(int) const override { return 1.0 / (side_ * side_); }
  int Locate(Vec3 direction) const override;
  // Never sure: false.
  bool HoldsBall(int, Vec3, double) const override { return false; }

 private:
  int side_;
};

}  // namespace lambert

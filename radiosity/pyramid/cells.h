// The hemisphere around +z in parts, in the local frame of a patch (x, y in its plane, z along its
// normal). The same for every patch.
#pragma once

#include "radiosity/core/vec3.h"

namespace lambert {

// Cells 0 .. size() - 1 share the hemisphere: every direction above the horizon is in exactly one.
class HemisphereCells {
 public:
  virtual ~HemisphereCells() = default;

  virtual int size() const = 0;
  // f_p: the fraction of a Lambertian emitter's flux that leaves through the cell; all sum to 1.
  virtual double flux_fraction(int cell) const = 0;
  // The cell that holds a direction (of any length > 0), or -1 below the horizon.
  virtual int Locate(Vec3 direction) const = 0;
  // True if the ball around `center` is surely wholly inside the cell.
  virtual bool HoldsBall(int cell, Vec3 center, double radius) const = 0;
};

}  // namespace lambert

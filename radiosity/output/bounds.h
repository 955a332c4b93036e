// The box around all patches.
#pragma once

#include "radiosity/patch/patch_set.h"

namespace lambert {

struct Bounds {
  Vec3 low, high;  // metres, relative to the patch set's origin
  Vec3 Center() const { return (low + high) * 0.5; }
  Vec3 Size() const { return high - low; }
  double Diagonal() const { return Length(Size()); }
};

// Requires: patches.size() > 0.
inline Bounds BoundsOf(const PatchSet& patches) {
  Bounds bounds{patches.corners[0][0], patches.corners[0][0]};
  for (const auto& triangle : patches.corners) {
    for (const Vec3& p : triangle) {
      Vec3& low = bounds.low;
      Vec3& high = bounds.high;
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  return bounds;
}

}  // namespace lambert

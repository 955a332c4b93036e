// Boxes along the axes. Values; any thread.
#pragma once

#include "radiosity/core/vec3.h"

namespace lambert {

struct Bounds {
  Vec3 low, high;
  void Add(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void Add(const Bounds& other) {
    Add(other.low);
    Add(other.high);
  }
  Vec3 Center() const { return (low + high) * 0.5; }
  Vec3 Size() const { return high - low; }
  double Diagonal() const { return Length(Size()); }
};

}  // namespace lambert

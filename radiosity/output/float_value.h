// double -> float32 for files that must hold neither infinities nor NaNs.
#pragma once

#include <algorithm>
#include <limits>

namespace lambert {

// The nearest float32; values beyond its range become its largest, NaN becomes 0.
inline float FloatValue(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (value != value) return 0;
  return static_cast<float>(std::clamp(value, -kLargest, kLargest));
}

}  // namespace lambert

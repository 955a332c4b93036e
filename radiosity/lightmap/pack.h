// Rectangles onto pages.
#pragma once

#include <vector>

namespace lambert {

inline constexpr int kLargestPage = 4096;  // texels a side: what every WebGL 2 device shows
inline constexpr int kMostPages = 4;

struct PackedRectangle {
  int width = 0, height = 0;   // texels, > 0
  int page = 0, x = 0, y = 0;  // set by PackRectangles: its upper left corner
};

struct PageSize {
  int width = 0, height = 0;  // texels
};

// Puts the rectangles side by side onto the smallest square page of 2^k texels a side that holds
// them all, its height cut to what is used; or onto up to kMostPages of `largest` texels a side.
// Empty where they do not fit. The same for the same sizes. Requires: largest is a power of two.
std::vector<PageSize> PackRectangles(std::vector<PackedRectangle>& rectangles,
                                     int largest = kLargestPage);

}  // namespace lambert

// How a patch's rays are divided over the parts of its hemisphere.
#pragma once

#include <cstdint>
#include <iterator>
#include <vector>

#include "radiosity/core/lanes.h"
#include "radiosity/pyramid/hemisphere.h"

namespace lambert {

// Fraction of a patch's rays for each cell; all > 0, sum 1 (JPS00, 3.2):
//   hf_p = (alpha1 f_p + alpha2 g_p) / (alpha1 + alpha2),  g_p = worth_p / sum of worth
// worth: n_ip by the paper's rule, f_p sqrt(S_p) by the rule of least variance. Nothing worth
// anything at all: g = f. No density falls below a hundredth of f_p: a cell whose density is zero
// would never send its flux, whatever stands there (only alpha1 < .01 is changed).
// Requires: f_p (`fractions`) and worth >= 0 for each cell, alpha1 and alpha2 >= 0, not both 0.
std::vector<float> CellDensities(const std::vector<double>& fractions,
                                 const std::vector<double>& worth, double alpha1, double alpha2);

// f_p sqrt(S_p) from f_p S_p, the second moment of what the rays through a cell are worth: rays
// divided like this give the sum over cells the least variance.
std::vector<double> LeastVariance(const std::vector<double>& fractions,
                                  const std::vector<double>& moments);

// A hemisphere cut finely where patches are many and coarsely where they are few.
struct AdaptivePyramids {
  std::vector<const SphericalTriangle*> pyramids;  // of any level; share the hemisphere
  std::vector<double> worth;                       // of each, summed over the finest inside
};
// From the initial triangles on, the pyramid with the greatest worth is split until there are
// `leaves` or none is left to split. Requires: worth >= 0 for each finest pyramid of `hemisphere`.
AdaptivePyramids SplitWhereWorthIs(const Hemisphere& hemisphere, const std::vector<double>& worth,
                                   int leaves);

// The rays [begin, end) of a visit go through one cell.
struct CellRays {
  int cell = 0;
  uint32_t begin = 0, end = 0;
  // Each carries the flux of the cell over this: their number, or, where less than one is expected,
  // the expectation, as a ray then also carries the flux of all the times when there is none.
  double share = 0;
};

// Cells laid end to end on [0, 2^32), each as long as its density, and at least 1: what is asked of
// them is exact. Immutable.
class CellSpans {
 public:
  CellSpans() = default;  // of no cells
  // Requires: densities > 0 that sum to 1 or so, fewer than 2^31.
  explicit CellSpans(const std::vector<float>& densities);

  int size() const { return static_cast<int>(begin_.size()); }
  // Fraction of the rays.
  double density(int cell) const { return static_cast<double>(End(cell) - begin_[cell]) * 0x1p-32; }

 private:
  friend class VisitCells;
  uint64_t End(int cell) const { return cell + 1 < size() ? begin_[cell + 1] : uint64_t{1} << 32; }

  std::vector<uint32_t> begin_;  // of each cell
};

// The cells of the rays of one visit: r_ip = density_ip r_i rays each, rounded systematically,
// never away: the fractions are carried from cell to cell starting at offset / 2^32, so that
// E[r_ip] over uniform offsets is exact, and the sum is exactly `ray_count`. One thread at a time.
class VisitCells {
 public:
  // `spans` must outlive it.
  VisitCells(const CellSpans& spans, uint32_t ray_count, uint32_t offset)
      : spans_(spans),
        ray_count_(ray_count),
        offset_(offset),
        rays_per_length_(0x1p-32 * ray_count),
        few_(ray_count < static_cast<uint32_t>(spans.size())) {}

  // The rays of the cell that a ray goes through. Requires: ray < ray_count; not less than the last
  // time.
  const CellRays& Of(uint32_t ray) {
    // Few rays: most cells have none, and to search is faster than to walk.
    if (few_ || rays_.end == 0) {
      if (ray - searched_ >= std::size(found_)) Search(ray);
      Take(found_[ray - searched_]);
    } else {
      while (rays_.end <= ray) Take(rays_.cell + 1);
    }
    return rays_;
  }

 private:
  uint32_t RaysBefore(uint64_t place) const {
    return static_cast<uint32_t>((place * ray_count_ + offset_) >> 32);
  }
  void Search(uint32_t ray);
  void Take(int cell) {
    const uint64_t begin = spans_.begin_[cell], end = spans_.End(cell);
    const uint32_t before = RaysBefore(begin), until = RaysBefore(end);
    const double expected =
        static_cast<double>(static_cast<int64_t>(end - begin)) * rays_per_length_;
    rays_ = {cell, before, until, Lesser(expected, 1) * (until - before)};
  }

  const CellSpans& spans_;
  const uint32_t ray_count_, offset_;
  const double rays_per_length_;
  const bool few_;
  CellRays rays_;
  int found_[16];  // cells of the rays from searched_ on
  uint32_t searched_ = ~0u - 16;
};

}  // namespace lambert

// Exchange areas of all pairs of patches: a symmetric matrix, kept once.
#pragma once

#include <cstddef>
#include <vector>

#include "radiosity/patch/patch_set.h"

namespace lambert {

class ExchangeMatrix {
 public:
  explicit ExchangeMatrix(PatchIndex size)
      : size_(size), self_(size), values_(static_cast<size_t>(size) * (size - 1) / 2) {}

  PatchIndex size() const { return size_; }
  // A_i F_ij [m2]. Requires: 0 <= i < j < size().
  double& at(PatchIndex i, PatchIndex j) { return values_[RowStart(i) + (j - i - 1)]; }
  double at(PatchIndex i, PatchIndex j) const { return values_[RowStart(i) + (j - i - 1)]; }

  // Makes row i sum to areas[i] by what a patch exchanges with itself, 0 before. Of a closed scene
  // the rows are known to, and errors of the pairs then count by the difference of their
  // radiosities; where those are equal, not at all.
  void CloseRows(const std::vector<double>& areas);

  // y_i = sum_j A_i F_ij x_j, always added in the same order.
  std::vector<double> Times(const std::vector<double>& x) const;

 private:
  size_t RowStart(PatchIndex i) const {
    return static_cast<size_t>(i) * (2 * static_cast<size_t>(size_) - i - 1) / 2;
  }

  PatchIndex size_;
  std::vector<double> self_;  // the diagonal
  std::vector<double> values_;
};

}  // namespace lambert

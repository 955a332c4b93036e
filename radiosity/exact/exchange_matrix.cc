#include "radiosity/exact/exchange_matrix.h"

namespace lambert {

std::vector<double> ExchangeMatrix::Times(const std::vector<double>& x) const {
  std::vector<double> y(size_);
  for (PatchIndex i = 0; i < size_; ++i) {
    const double* row = values_.data() + RowStart(i);
    const double* right = x.data() + i + 1;
    double* below = y.data() + i + 1;
    const PatchIndex length = size_ - i - 1;
    double sums[4] = {0, 0, 0, 0};  // four, so that additions need not wait for one another
    for (PatchIndex k = 0; k < length; ++k) {
      sums[k % 4] += row[k] * right[k];
      below[k] += row[k] * x[i];
    }
    y[i] += (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
  return y;
}

}  // namespace lambert

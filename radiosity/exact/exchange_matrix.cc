#include "radiosity/exact/exchange_matrix.h"

namespace lambert {

void ExchangeMatrix::CloseRows(const std::vector<double>& areas) {
  const std::vector<double> sums = Times(std::vector<double>(size_, 1.0));
  for (PatchIndex i = 0; i < size_; ++i) self_[i] += areas[i] - sums[i];
}

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
    y[i] += self_[i] * x[i] + (sums[0] + sums[1]) + (sums[2] + sums[3]);
  }
  return y;
}

}  // namespace lambert

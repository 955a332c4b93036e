#include "radiosity/exact/balance.h"

#include <algorithm>
#include <cmath>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr double kTolerance = 1e-13;  // residual, relative to what it is the difference of
// Conjugate gradients need about sqrt(1 / (1 - rho)) * 15 iterations: 15,000 for rho = .999999.
constexpr int kMaxIterations = 30000;

using Vector = std::vector<double>;

double Sum(const Vector& x, const Vector& y) {
  double sum = 0;
  for (size_t i = 0; i < x.size(); ++i) sum += x[i] * y[i];
  return sum;
}

class System {
 public:
  System(const ExchangeMatrix& exchange, const Lighting& lighting)
      : exchange_(exchange), area_(lighting.area_m2), root_(lighting.reflectance) {
    for (double& root : root_) root = std::sqrt(root);
  }
  Vector RightSide(const Lighting& lighting) const {
    Vector x = lighting.emitted;
    for (size_t i = 0; i < x.size(); ++i) x[i] /= area_[i];
    Vector y = exchange_.Times(x);
    for (size_t i = 0; i < y.size(); ++i) y[i] = root_[i] * (y[i] + lighting.direct[i]);
    return y;
  }
  Vector Times(const Vector& u) const {
    Vector x = u;
    for (size_t i = 0; i < x.size(); ++i) x[i] *= root_[i];
    Vector y = exchange_.Times(x);
    for (size_t i = 0; i < y.size(); ++i) y[i] = area_[i] * u[i] - root_[i] * y[i];
    return y;
  }
  // direct + G (emitted / A + sqrt(rho) u): what arrives, also at black patches.
  Vector Arrived(const Vector& u, const Lighting& lighting) const {
    Vector x(u.size());
    for (size_t i = 0; i < x.size(); ++i) x[i] = lighting.emitted[i] / area_[i] + root_[i] * u[i];
    Vector y = exchange_.Times(x);
    for (size_t i = 0; i < y.size(); ++i) y[i] += lighting.direct[i];
    return y;
  }
  // x^T A^-1 x.
  double Square(const Vector& x) const {
    double sum = 0;
    for (size_t i = 0; i < x.size(); ++i) sum += x[i] * x[i] / area_[i];
    return sum;
  }
  double SquareOfDiagonal(const Vector& u) const {
    double sum = 0;
    for (size_t i = 0; i < u.size(); ++i) sum += u[i] * u[i] * area_[i];
    return sum;
  }
  const Vector& area() const { return area_; }

 private:
  const ExchangeMatrix& exchange_;
  const Vector& area_;
  Vector root_;  // sqrt(rho)
};

}  // namespace

absl::Status SingularBalance() {
  return MakeError(absl::StatusCode::kFailedPrecondition,
                   {"SINGULAR_CLOSED_RHO_1", "scene",
                    "the balance of flux has no solution: nothing is absorbed or escapes",
                    "give some material a reflectance under 1"});
}

absl::StatusOr<std::vector<double>> ArrivedFlux(const ExchangeMatrix& exchange,
                                                const Lighting& lighting) {
  const System system(exchange, lighting);
  Vector residual = system.RightSide(lighting);
  const size_t n = residual.size();
  Vector u(n), direction(n);
  for (size_t i = 0; i < n; ++i) direction[i] = residual[i] / system.area()[i];
  const double right2 = system.Square(residual);
  double residual2 = right2;
  for (int iteration = 0;; ++iteration) {
    const double size2 = std::max(right2, system.SquareOfDiagonal(u));
    if (residual2 <= kTolerance * kTolerance * size2) break;
    const Vector image = system.Times(direction);
    const double curvature = Sum(direction, image);
    if (!(curvature > 0) || iteration == kMaxIterations) return SingularBalance();
    const double step = residual2 / curvature;
    for (size_t i = 0; i < n; ++i) {
      u[i] += step * direction[i];
      residual[i] -= step * image[i];
    }
    const double before = residual2;
    residual2 = system.Square(residual);
    const double share = residual2 / before;
    for (size_t i = 0; i < n; ++i) {
      direction[i] = residual[i] / system.area()[i] + share * direction[i];
    }
  }
  return system.Arrived(u, lighting);
}

}  // namespace lambert

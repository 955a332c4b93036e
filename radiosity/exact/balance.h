// The linear system of radiosity, one channel.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/exact/exchange_matrix.h"

namespace lambert {

struct Lighting {
  std::vector<double> area_m2;
  std::vector<double> reflectance;
  std::vector<double> emitted;  // flux, any unit
  std::vector<double> direct;   // flux that arrives from point lights, same unit
};

// Flux that arrives at each patch over all bounces, in the unit of `emitted`. With b the flux that
// arrives and G the exchange areas:  b = direct + G (emitted + rho b) / A.  Put symmetrically with
// u = sqrt(rho) b / A  it is positive definite,
//   (A - sqrt(rho) G sqrt(rho)) u = sqrt(rho) (direct + G emitted / A),
// and solved by conjugate gradients (HS52), with A as preconditioner, to a residual of 1e-13.
// FAILED_PRECONDITION (SINGULAR_CLOSED_RHO_1) where flux has no way out.
absl::StatusOr<std::vector<double>> ArrivedFlux(const ExchangeMatrix& exchange,
                                                const Lighting& lighting);

// The error of a scene that keeps all flux.
absl::Status SingularBalance();

}  // namespace lambert

// The judge of the other methods: closed forms, dense samples, a linear system.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/exact/exchange.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// Any number of threads may use it at once; the patch set and the ray scene must outlive it. Making
// it takes time and memory by the square of the patches: see Exchange.
class ExactSolver {
 public:
  ExactSolver(const PatchSet& patches, const RayScene& scene, bool may_hide = true);

  // How much of whose light arrives where in one pass: shared by the channels of the pass.
  // `emitted` is by emitter, the mean of its channels; it steers the samples to where they matter.
  Transport SampleTransport(const std::vector<double>& emitted, int64_t rays, uint64_t seed,
                            uint32_t pass) const;

  // Flux that arrives at each patch over all bounces, in the unit of `emitted`; fails as
  // ArrivedFlux does.
  absl::StatusOr<std::vector<double>> Solve(const Transport& transport,
                                            const std::vector<double>& emitted,
                                            const std::vector<double>& reflectance) const;

 private:
  std::vector<double> LinkWeights(const std::vector<double>& emitted) const;

  const PatchSet& patches_;
  const Exchange exchange_;
};

}  // namespace lambert

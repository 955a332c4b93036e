// Runs units of work: const input to new output.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/options.h"
#include "radiosity/shoot/unit.h"

namespace lambert {

// Everything that a result depends on beside the unit and the patch set: ray tracer, instruction
// set, build quality, sampling code. Two programs with equal versions return equal bytes; a
// coordinator gives work only to workers of its own version.
std::string UnitVersion();

// One patch set made ready to shoot from. Immutable from outside; Run may be called by any number
// of threads at once. It creates no threads.
class Shooter {
 public:
  // Fails with FAILED_PRECONDITION where the processor lacks AVX2, RESOURCE_EXHAUSTED where there
  // is too little memory, FIELD_INVALID where the method takes fewer patches. Holds on to `patches`
  // only where the method reads them while it shoots; of their exitance it reads whether a room is
  // lit, for the densities alone. Requires:
  // options.method is not kAuto.
  static absl::StatusOr<std::shared_ptr<const Shooter>> Create(
      std::shared_ptr<const PatchSet> patches, const ShootOptions& options);
  virtual ~Shooter() = default;

  // The result depends only on the unit, the patch set and the options: bit for bit.
  // INVALID_ARGUMENT for a unit that names an emitter or a range of rays that does not exist, or
  // that holds negative quanta or too many (kMaxUnitQuanta; with `exact`, 4.6e18).
  virtual absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const = 0;
};

}  // namespace lambert

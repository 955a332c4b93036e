// The method `exact` as a shooter: a unit of it is a whole pass.
#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "radiosity/shoot/shooter.h"

namespace lambert {

// A unit holds one visit of each emitter with all its emission. Its rays, in sum, are the segments
// that sample the visibility of the pairs that something may stand between; where there are none,
// they count all the same. The result's deposits are what arrives at each patch over all bounces,
// each with one hit; `shot` is what is emitted and reflected. Run fails with FAILED_PRECONDITION
// (SINGULAR_CLOSED_RHO_1) where flux has no way out. Making the shooter takes the time of all
// closed forms. Without the part visibility none is traced. Fails as Shooter::Create does.
absl::StatusOr<std::shared_ptr<const Shooter>> CreateExactShooter(
    std::shared_ptr<const PatchSet> patches, const ShootOptions& options);

}  // namespace lambert

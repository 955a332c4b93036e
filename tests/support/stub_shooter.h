// Shoots without rays: for farms in which the coordinator is what is looked at.
#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "radiosity/shoot/shooter.h"

namespace lambert {

// A worker's shooter. All rays of an emitter arrive at one patch, so results are sound and equal
// wherever they are made, and cost next to nothing. Of methods that keep no statistics.
absl::StatusOr<std::shared_ptr<const Shooter>> MakeStubShooter(
    std::shared_ptr<const PatchSet> patches, const ShootOptions& options);

}  // namespace lambert

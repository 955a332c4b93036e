// A gather as units of work, for whatever runs units of shooting: the k-th "ray" of a unit is a
// number of its result, 2 i what arrives at point i and 2 i + 1 its standard error. Each comes back
// as one deposit of its own, its quanta the bits of a float32 >= 0: sums of results are then what
// is in either, in any order, to the bit.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/gather/gather_points.h"
#include "radiosity/shoot/shooter.h"
#include "radiosity/shoot/unit.h"

namespace lambert {

// All points, cut into units of about 10 ms each.
std::vector<WorkUnit> CutGather(size_t points, int rays_per_point);

// What the merged result of all units says. RESULT_INVALID (DATA_LOSS) where a point is missing or
// a value is no number >= 0.
absl::StatusOr<Gathered> GatheredOf(const UnitResult& result, size_t points);

// Runs such units. Fails as Gatherer::Create, and with GATHER_INVALID where the task is not about
// these patches.
absl::StatusOr<std::shared_ptr<const Shooter>> MakeGatherShooter(
    std::shared_ptr<const PatchSet> patches, const GatherTask& task);

}  // namespace lambert

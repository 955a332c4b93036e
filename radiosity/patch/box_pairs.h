// Boxes that meet.
#pragma once

#include <vector>

#include "absl/functional/function_ref.h"
#include "radiosity/core/bounds.h"

namespace lambert {

// Calls `visit` with i < j for each two of `boxes` that are no further apart than `slack` along any
// axis, by a tree that halves their order: n log n, and the pairs, where boxes near in the order
// are near in space.
void ForEachMeetingPair(const std::vector<Bounds>& boxes, double slack,
                        absl::FunctionRef<void(size_t i, size_t j)> visit);

}  // namespace lambert

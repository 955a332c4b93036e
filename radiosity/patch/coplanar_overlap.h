// Patches that lie on each other.
#pragma once

#include <cstdint>

#include "radiosity/patch/patch_set.h"

namespace lambert {

struct CoplanarOverlaps {
  int64_t patches = 0;                            // that share area with another one
  PatchIndex first = kNoPatch, other = kNoPatch;  // the least of them, and the least that it meets
};

// Patches that face one way in one plane and share area: which of them a ray hits is undefined.
// Backs of two-sided patches are patches of their own; patches back to back do not meet. Planes are
// one where they differ by less than the rounding of a float32 coordinate as large as the scene's
// diagonal, and what is shared must be wider than that: neighbours along an edge share nothing.
// Patches of under a thousandth of the diagonal may be missed where rounding turns them.
// N log N and the pairs whose boxes meet in one plane.
CoplanarOverlaps FindCoplanarOverlaps(const PatchSet& patches);

}  // namespace lambert

// Patches given twice.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/core/vec3.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// Takes out of `order` every patch with the same three corners and the same winding as one before
// it in `order`, and returns how many those were: a ray can hit only one of them, so the others
// would stay dark. Only patches of equal codes are compared. Requires: `order` sorted by `codes`.
int64_t RemoveDuplicates(const std::vector<std::array<Vec3, 3>>& corners,
                         const std::vector<uint64_t>& codes, std::vector<PatchIndex>* order);

}  // namespace lambert

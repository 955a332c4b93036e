// Whether nothing can stand between two patches.
#pragma once

#include "radiosity/patch/patch_set.h"

namespace lambert {

// True only where all corners and point lights lie on the front of every patch's plane, or behind
// it by less than a millionth of the scene's diagonal: a room without furniture, seen from inside.
// False says nothing: it ends at the first corner that is behind, or after 1e8 of them.
bool IsConvex(const PatchSet& patches);

}  // namespace lambert

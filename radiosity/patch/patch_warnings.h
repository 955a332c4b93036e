// What a finished patch set should make its user think of.
#pragma once

#include "radiosity/patch/patch_set.h"

namespace lambert {

// Appends to patches->warnings: NO_EMITTERS; EMISSION_HIGH with the number of patches that are
// brighter than 1e10 nit; REFLECTANCE_HIGH with the number of patches that
// reflect more than 95 %; LIGHT_ON_SURFACE with the number of point lights within 1e-6 of the
// scene's diagonal of a patch, and the first of them; POSSIBLY_INVERTED_NORMALS where the one-sided
// patches close a surface that faces outward.
void AppendPatchWarnings(PatchSet* patches);

}  // namespace lambert

// Whether a scene is closed: then every row of form factors sums to one, whatever hides what.
#pragma once

#include "radiosity/patch/patch_set.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// True where none of some 4 million rays that leave the patches by the cosine law, at most 4,096 a
// patch, escapes or meets a back. Always the same rays. A scene that loses under about a millionth
// of its light may pass for closed.
bool IsClosed(const PatchSet& patches, const RayScene& scene);

}  // namespace lambert

// Light of pictures and models by a final gather: at their own points, instead of the patches'
// means carried over to corners (smooth.h).
#pragma once

#include <array>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/gather/gather_points.h"
#include "radiosity/output/smooth.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// Normals at the corners of every patch: of each fan the mean of its patches', weighted by area, so
// that curved surfaces show no facets.
std::vector<std::array<Vec3, 3>> SmoothNormals(const PatchSet& patches, const CornerFans& fans);

// Irradiance at the corners of every patch, one gather for each fan, a little inside its largest
// patch: on the edge itself two walls would see each other's thickness. A corner for which its
// patch does not speak (survey.h) has the mean of those for which it does or, without any, what
// arrives at the patch's centroid. Fails as `gather` does. Requires: fans and normals of these
// patches.
absl::StatusOr<std::vector<std::array<Rgb, 3>>> GatherCorners(
    const PatchSet& patches, const CornerFans& fans,
    const std::vector<std::array<Vec3, 3>>& normals, const GatherFunction& gather);

}  // namespace lambert

// The triangles of a scene where its nodes put them.
#pragma once

#include <array>

#include "absl/functional/function_ref.h"
#include "absl/status/status.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

struct PlacedTriangle {
  std::array<Vec3, 3> corners;       // metres, relative to the origin asked for
  std::array<uint32_t, 3> vertices;  // of the primitive, in the order of `corners`
  const Primitive* primitive = nullptr;
  PatchSource source;
};

// Calls `visit` for every triangle of every instance, in the order of the scene, until it fails.
// Corners are counter-clockwise seen from the front: where an instance mirrors, the winding of the
// file is turned round here, and nowhere else. The origin is taken off the transform, in double,
// before it meets a vertex: a small object far away keeps its digits.
// Requires: indices of the scene in range.
absl::Status ForEachTriangle(const Scene& scene, Vec3 origin,
                             absl::FunctionRef<absl::Status(const PlacedTriangle&)> visit);

}  // namespace lambert

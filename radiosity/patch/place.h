// The triangles of a scene where its nodes put them.
#pragma once

#include <array>

#include "absl/functional/function_ref.h"
#include "absl/status/status.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// From the file's world to that of patches.
struct Placement {
  Vec3 origin;  // metres: what world positions are made relative to
  double metres_per_unit = 1;

  Vec3 Place(Vec3 world) const { return world * metres_per_unit - origin; }
  Transform Place(const Transform& world) const {
    return {world.x * metres_per_unit, world.y * metres_per_unit, world.z * metres_per_unit,
            Place(world.translation)};
  }
};

// Index in the file of the mesh that an instance shows, also where it shows it in a pose of its
// own: what PatchSource names.
int32_t FileMeshOf(const Scene& scene, const Instance& instance);

// Makes metres of the file's unit, for all that a scene shows.
void ScaleInstances(double metres_per_unit, Scene& scene);

struct PlacedTriangle {
  std::array<Vec3, 3> corners;       // metres, placed
  std::array<uint32_t, 3> vertices;  // of the primitive, in the order of `corners`
  const Primitive* primitive = nullptr;
  PatchSource source;
};

// Calls `visit` for every triangle of every instance, in the order of the scene, until it fails.
// Corners are counter-clockwise seen from the front: where an instance mirrors, the winding of the
// file is turned round here, and nowhere else. Transforms are placed, in double, before they meet
// a vertex: a small object far away keeps its digits.
// Requires: indices of the scene in range.
absl::Status ForEachTriangle(const Scene& scene, const Placement& placement,
                             absl::FunctionRef<absl::Status(const PlacedTriangle&)> visit);

}  // namespace lambert

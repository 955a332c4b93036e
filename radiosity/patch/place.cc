#include "radiosity/patch/place.h"

#include <utility>

namespace lambert {

int32_t FileMeshOf(const Scene& scene, const Instance& instance) {
  const int pose_of = scene.meshes[instance.mesh].pose_of;
  return pose_of < 0 ? instance.mesh : pose_of;
}

void ScaleInstances(double metres_per_unit, Scene& scene) {
  for (Instance& instance : scene.instances) {
    instance.world = Placement{{}, metres_per_unit}.Place(instance.world);
  }
}

absl::Status ForEachTriangle(const Scene& scene, const Placement& placement,
                             absl::FunctionRef<absl::Status(const PlacedTriangle&)> visit) {
  for (const Instance& instance : scene.instances) {
    const Transform world = placement.Place(instance.world);
    const bool mirrors = world.Determinant() < 0;
    const Mesh& mesh = scene.meshes[instance.mesh];
    const int32_t of_file = FileMeshOf(scene, instance);
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
      const Primitive& primitive = mesh.primitives[p];
      for (size_t t = 0; t < primitive.triangles.size(); ++t) {
        PlacedTriangle placed;
        placed.vertices = primitive.triangles[t];
        if (mirrors) std::swap(placed.vertices[1], placed.vertices[2]);
        for (int k = 0; k < 3; ++k) {
          placed.corners[k] = world.Point(FromFloats(primitive.positions[placed.vertices[k]]));
        }
        placed.primitive = &primitive;
        placed.source = {instance.node, of_file, static_cast<int32_t>(p), static_cast<int32_t>(t)};
        absl::Status status = visit(placed);
        if (!status.ok()) return status;
      }
    }
  }
  return absl::OkStatus();
}

}  // namespace lambert

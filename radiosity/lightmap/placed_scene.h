// The triangles of a scene, and which of them each patch is a piece of.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// One triangle of a primitive, placed.
struct SurfaceTriangle {
  std::array<Vec3, 3> corners;         // metres, relative to the patch set's origin
  std::array<uint32_t, 3> vertices{};  // of the primitive, in the order of `corners`
  bool has_area = true;                // by IsDegenerate
};

// One primitive of one instance.
struct PlacedSurface {
  int32_t instance = 0, primitive = 0;  // Scene::instances, Mesh::primitives
  int32_t first = 0, count = 0;         // its triangles
};

struct PlacedScene {
  std::vector<PlacedSurface> surfaces;     // in the order of the scene; none is empty
  std::vector<SurfaceTriangle> triangles;  // of all surfaces

  // Index of the surface of a triangle.
  int32_t SurfaceOf(int32_t triangle) const;
};

// `origin`: PatchSet::origin. Requires: indices of the scene in range.
PlacedScene PlaceScene(const Scene& scene, Vec3 origin);

const Primitive& PrimitiveOf(const Scene& scene, const PlacedSurface& surface);

// Whether every patch names a triangle that an instance of the scene shows: a set that came from
// elsewhere may not.
bool SourcesExist(const Scene& scene, const PatchSet& patches);

// By patch: the triangle that it is a piece of. Instances that one node makes share their sources:
// there it is the triangle that the patch lies in. Requires: SourcesExist.
std::vector<int32_t> FindTriangles(const Scene& scene, const PlacedScene& placed,
                                   const PatchSet& patches);

// Weights of the three corners at the point of their plane that is nearest to `p`; they sum to 1.
// Requires: the triangle has an area.
Vec3 WeightsAt(const std::array<Vec3, 3>& corners, Vec3 p);

}  // namespace lambert

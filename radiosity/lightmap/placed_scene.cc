#include "radiosity/lightmap/placed_scene.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "radiosity/patch/place.h"
#include "radiosity/patch/shape.h"

namespace lambert {
namespace {

// How far a point is from a triangle, about: off its plane, and outside its edges.
double DistanceTo(const std::array<Vec3, 3>& corners, Vec3 p) {
  const Vec3 w = WeightsAt(corners, p);
  const Vec3 on_plane = corners[0] * w.x + corners[1] * w.y + corners[2] * w.z;
  const double outside = -std::min({w.x, w.y, w.z, 0.0});
  return Length(p - on_plane) + outside * Length(corners[1] - corners[0]);
}

}  // namespace

int32_t PlacedScene::SurfaceOf(int32_t triangle) const {
  const auto after = std::upper_bound(
      surfaces.begin(), surfaces.end(), triangle,
      [](int32_t wanted, const PlacedSurface& surface) { return wanted < surface.first; });
  return static_cast<int32_t>(after - surfaces.begin()) - 1;
}

PlacedScene PlaceScene(const Scene& scene, Vec3 origin) {
  PlacedScene made;
  (void)ForEachTriangle(scene, {origin}, [&made](const PlacedTriangle& placed) {
    const bool has_area = !IsDegenerate(placed.corners, Measure(placed.corners));
    made.triangles.push_back({placed.corners, placed.vertices, has_area});
    return absl::OkStatus();
  });
  int32_t first = 0;
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
    for (size_t p = 0; p < mesh.primitives.size(); ++p) {
      const auto count = static_cast<int32_t>(mesh.primitives[p].triangles.size());
      if (count == 0) continue;
      made.surfaces.push_back({static_cast<int32_t>(i), static_cast<int32_t>(p), first, count});
      first += count;
    }
  }
  return made;
}

const Primitive& PrimitiveOf(const Scene& scene, const PlacedSurface& surface) {
  return scene.meshes[scene.instances[surface.instance].mesh].primitives[surface.primitive];
}

bool SourcesExist(const Scene& scene, const PatchSet& patches) {
  std::map<std::pair<int32_t, int32_t>, const Mesh*> shown;  // by node and mesh
  for (const Instance& instance : scene.instances) {
    shown[{instance.node, FileMeshOf(scene, instance)}] = &scene.meshes[instance.mesh];
  }
  return std::all_of(patches.source.begin(), patches.source.end(), [&](const PatchSource& source) {
    const auto mesh = shown.find({source.node, source.mesh});
    if (mesh == shown.end()) return false;
    const std::vector<Primitive>& primitives = mesh->second->primitives;
    if (source.primitive < 0 || source.triangle < 0) return false;
    return static_cast<size_t>(source.primitive) < primitives.size() &&
           static_cast<size_t>(source.triangle) < primitives[source.primitive].triangles.size();
  });
}

std::vector<int32_t> FindTriangles(const Scene& scene, const PlacedScene& placed,
                                   const PatchSet& patches) {
  std::map<std::tuple<int32_t, int32_t, int32_t>, std::vector<int32_t>> first_of;
  for (const PlacedSurface& surface : placed.surfaces) {
    const Instance& instance = scene.instances[surface.instance];
    first_of[{instance.node, FileMeshOf(scene, instance), surface.primitive}].push_back(
        surface.first);
  }
  std::vector<int32_t> found;
  found.reserve(patches.corners.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const PatchSource& source = patches.source[i];
    const std::vector<int32_t>& first = first_of.at({source.node, source.mesh, source.primitive});
    int32_t best = first[0] + source.triangle;
    if (first.size() > 1) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int32_t start : first) {
        const double distance = DistanceTo(placed.triangles[start + source.triangle].corners,
                                           PatchCentroid(patches, i));
        if (distance >= nearest) continue;
        nearest = distance;
        best = start + source.triangle;
      }
    }
    found.push_back(best);
  }
  return found;
}

Vec3 WeightsAt(const std::array<Vec3, 3>& corners, Vec3 p) {
  const Vec3 u = corners[1] - corners[0], v = corners[2] - corners[0], at = p - corners[0];
  const Vec3 normal = Cross(u, v);
  const double squared = Dot(normal, normal);
  const double b = Dot(Cross(at, v), normal) / squared, c = Dot(Cross(u, at), normal) / squared;
  return {1 - b - c, b, c};
}

}  // namespace lambert

#include "radiosity/lightmap/placed_scene.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "radiosity/core/bounds.h"
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

double DistanceTo(const Bounds& box, Vec3 p) {
  const Vec3 off{std::max({box.low.x - p.x, p.x - box.high.x, 0.0}),
                 std::max({box.low.y - p.y, p.y - box.high.y, 0.0}),
                 std::max({box.low.z - p.z, p.z - box.high.z, 0.0})};
  return Length(off);
}

// The surfaces that the instances of one node make of one primitive: a tree of boxes.
class Copies {
 public:
  void Add(const PlacedScene& placed, const PlacedSurface& surface) {
    const Vec3 any = placed.triangles[surface.first].corners[0];
    Copy copy{surface.first, {any, any}};
    for (int32_t t = surface.first; t < surface.first + surface.count; ++t) {
      for (const Vec3& corner : placed.triangles[t].corners) copy.box.Add(corner);
    }
    copies_.push_back(copy);
  }

  // After the last Add.
  void MakeTree() {
    around_.resize(2 * copies_.size());
    Split(0, 0, copies_.size());
  }

  // Of the triangles `t` of the copies the one nearest to `p`, the first of equals.
  int32_t Nearest(const PlacedScene& placed, int32_t t, Vec3 p) const {
    Search search{placed, t, p};
    Visit(0, 0, copies_.size(), search);
    return search.best;
  }

 private:
  struct Copy {
    int32_t first = 0;  // of its triangles
    Bounds box;
  };
  struct Search {
    const PlacedScene& placed;
    int32_t triangle;
    Vec3 p;
    double nearest = std::numeric_limits<double>::infinity();
    int32_t best = std::numeric_limits<int32_t>::max();
  };

  // n copies have a tree of 2 n - 1 nodes: their own, those of the first half, and of the second.
  static size_t Second(size_t node, size_t half) { return node + 2 * half; }

  void Split(size_t node, size_t begin, size_t end) {
    Bounds& around = around_[node];
    around = copies_[begin].box;
    for (size_t i = begin + 1; i < end; ++i) around.Add(copies_[i].box);
    if (end - begin == 1) return;
    const Vec3 size = around.Size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle = [axis](const Copy& copy) {
      const Vec3 center = copy.box.Center();
      return axis == 0 ? center.x : axis == 1 ? center.y : center.z;
    };
    const size_t half = (end - begin) / 2;
    std::nth_element(copies_.begin() + begin, copies_.begin() + begin + half, copies_.begin() + end,
                     [&](const Copy& a, const Copy& b) { return middle(a) < middle(b); });
    Split(node + 1, begin, begin + half);
    Split(Second(node, half), begin + half, end);
  }

  void Visit(size_t node, size_t begin, size_t end, Search& search) const {
    if (DistanceTo(around_[node], search.p) > search.nearest) return;
    if (end - begin > 1) {
      const size_t half = (end - begin) / 2;
      Visit(node + 1, begin, begin + half, search);
      Visit(Second(node, half), begin + half, end, search);
      return;
    }
    const int32_t triangle = copies_[begin].first + search.triangle;
    const double distance = DistanceTo(search.placed.triangles[triangle].corners, search.p);
    if (distance > search.nearest || (distance == search.nearest && triangle > search.best)) return;
    search.nearest = distance;
    search.best = triangle;
  }

  std::vector<Copy> copies_;
  std::vector<Bounds> around_;  // by node
};

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
  std::map<std::tuple<int32_t, int32_t, int32_t>, Copies> copies_of;
  for (const PlacedSurface& surface : placed.surfaces) {
    const Instance& instance = scene.instances[surface.instance];
    copies_of[{instance.node, FileMeshOf(scene, instance), surface.primitive}].Add(placed, surface);
  }
  for (auto& [source, copies] : copies_of) copies.MakeTree();
  std::vector<int32_t> found;
  found.reserve(patches.corners.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const PatchSource& source = patches.source[i];
    const Copies& copies = copies_of.at({source.node, source.mesh, source.primitive});
    found.push_back(copies.Nearest(placed, source.triangle, PatchCentroid(patches, i)));
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

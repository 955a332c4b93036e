// WorkPlanes: which floors a scene has, and the sensors above them.
#include <algorithm>
#include <cmath>
#include <map>

#include "radiosity/core/bounds.h"
#include "radiosity/core/disjoint_sets.h"
#include "radiosity/core/error.h"
#include "radiosity/output/sensors.h"
#include "radiosity/output/weld.h"

namespace lambert {
namespace {

constexpr double kUpward = 0.985;       // y of a normal: level to 10 degrees
constexpr double kLeastFloor_m2 = 2;    // smaller ones are furniture
constexpr double kLeastStorey_m = 1.8;  // nearer to the floor below it is a table

struct Floor {
  std::vector<PatchIndex> patches;
  Bounds bounds;
  double area_m2 = 0;
};

// Upward patches that share corners, in the order of their first patches.
std::vector<Floor> UpwardSurfaces(const PatchSet& patches) {
  const std::vector<std::array<int32_t, 3>> vertices = WeldCorners(patches).vertex;
  const auto is_upward = [&](PatchIndex i) { return PatchNormal(patches, i).y > kUpward; };
  DisjointSets sets(patches.corners.size());
  std::map<int32_t, PatchIndex> first;  // upward patch by vertex
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!is_upward(i)) continue;
    for (int32_t vertex : vertices[i]) sets.Join(i, first.emplace(vertex, i).first->second);
  }
  std::map<int32_t, Floor> floors;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!is_upward(i)) continue;
    Floor& floor = floors[sets.Find(i)];
    if (floor.patches.empty()) floor.bounds = {patches.corners[i][0], patches.corners[i][0]};
    floor.patches.push_back(i);
    floor.area_m2 += patches.area_m2[i];
    for (const Vec3& corner : patches.corners[i]) floor.bounds.Add(corner);
  }
  std::vector<Floor> list;
  for (auto& [set, floor] : floors) list.push_back(std::move(floor));
  return list;
}

bool Overlap(const Bounds& a, const Bounds& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.z < b.high.z && b.low.z < a.high.z;
}

std::vector<Floor> FindFloors(const PatchSet& patches) {
  std::vector<Floor> surfaces = UpwardSurfaces(patches), floors;
  std::erase_if(surfaces, [](const Floor& floor) { return floor.area_m2 < kLeastFloor_m2; });
  std::stable_sort(surfaces.begin(), surfaces.end(),
                   [](const Floor& a, const Floor& b) { return a.bounds.low.y < b.bounds.low.y; });
  for (Floor& surface : surfaces) {
    const bool is_furniture = std::any_of(floors.begin(), floors.end(), [&](const Floor& below) {
      return Overlap(below.bounds, surface.bounds) &&
             surface.bounds.low.y - below.bounds.low.y < kLeastStorey_m;
    });
    if (!is_furniture) floors.push_back(std::move(surface));
  }
  return floors;
}

// Whether a triangle, seen from above, holds a place.
bool Holds(const std::array<Vec3, 3>& corners, double x, double z) {
  int left = 0, right = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = corners[k], b = corners[(k + 1) % 3];
    const double side = (b.x - a.x) * (z - a.z) - (b.z - a.z) * (x - a.x);
    left += side >= 0;
    right += side <= 0;
  }
  return left == 3 || right == 3;
}

SensorGrid GridOver(const PatchSet& patches, const Floor& floor, double height_m) {
  const Vec3 low = floor.bounds.low, size = floor.bounds.Size();
  const double width = size.x - 2 * kWallZone_m, depth = size.z - 2 * kWallZone_m;
  SensorGrid grid;
  if (width <= 0 || depth <= 0) return grid;
  const double spacing = GridSpacing(width, depth);
  const int columns = PointsAlong(width, spacing), rows = PointsAlong(depth, spacing);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec3 at{low.x + kWallZone_m + (column + 0.5) * width / columns, low.y + height_m,
                    low.z + kWallZone_m + (row + 0.5) * depth / rows};
      const auto below = [&](PatchIndex i) { return Holds(patches.corners[i], at.x, at.z); };
      if (!std::any_of(floor.patches.begin(), floor.patches.end(), below)) continue;
      grid.position_m.push_back(patches.origin + at);
      grid.normal.push_back({0, 1, 0});
    }
  }
  return grid;
}

}  // namespace

absl::StatusOr<std::vector<SensorGrid>> WorkPlanes(const PatchSet& patches, double height_m) {
  std::vector<SensorGrid> grids;
  for (const Floor& floor : FindFloors(patches)) {
    SensorGrid grid = GridOver(patches, floor, height_m);
    if (grid.position_m.empty()) continue;
    grid.name = "work plane " + std::to_string(grids.size() + 1);
    grids.push_back(std::move(grid));
  }
  if (!grids.empty()) return grids;
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"SENSORS_INVALID", "--work-plane", "the scene has no floor of 2 m2 or more",
                    "say where the sensors are: --sensors FILE"});
}

}  // namespace lambert

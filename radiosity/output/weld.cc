#include "radiosity/output/weld.h"

#include <bit>
#include <cmath>
#include <unordered_map>

#include "radiosity/core/bounds.h"

namespace lambert {
namespace {

constexpr double kWeldShare = 1e-6;  // of the scene's diagonal

uint64_t Mix(uint64_t hash, uint64_t value) {
  hash = (hash ^ value) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 29);
}

struct PointHash {
  size_t operator()(const Vec3& p) const {
    uint64_t hash = 0;
    for (double coordinate : {p.x, p.y, p.z}) {
      hash = Mix(hash, std::bit_cast<uint64_t>(coordinate + 0.0));  // -0 and 0 are one point
    }
    return hash;
  }
};

struct Cell {
  int64_t x = 0, y = 0, z = 0;
  bool operator==(const Cell&) const = default;
};

struct CellHash {
  size_t operator()(const Cell& cell) const {
    return Mix(Mix(Mix(0, static_cast<uint64_t>(cell.x)), static_cast<uint64_t>(cell.y)),
               static_cast<uint64_t>(cell.z));
  }
};

// Vertices so far, found again by the cell of a grid whose cells are twice the tolerance wide: all
// points within the tolerance of p lie in the 8 cells around the grid corner nearest to p.
class VertexGrid {
 public:
  VertexGrid(Vec3 low, double tolerance) : low_(low), tolerance_(tolerance) {}

  int32_t FindOrAdd(Vec3 p) {
    const Vec3 grid = (p - low_) / (2 * tolerance_);
    const Cell corner{std::llround(grid.x), std::llround(grid.y), std::llround(grid.z)};
    for (int around = 0; around < 8; ++around) {
      const Cell cell{corner.x - (around & 1), corner.y - (around >> 1 & 1),
                      corner.z - (around >> 2)};
      const auto range = by_cell_.equal_range(cell);
      for (auto it = range.first; it != range.second; ++it) {
        if (Length(points_[it->second] - p) <= tolerance_) return it->second;
      }
    }
    const Cell own{static_cast<int64_t>(std::floor(grid.x)),
                   static_cast<int64_t>(std::floor(grid.y)),
                   static_cast<int64_t>(std::floor(grid.z))};
    by_cell_.emplace(own, count());
    points_.push_back(p);
    return count() - 1;
  }
  int32_t count() const { return static_cast<int32_t>(points_.size()); }

 private:
  Vec3 low_;
  double tolerance_;
  std::vector<Vec3> points_;
  std::unordered_multimap<Cell, int32_t, CellHash> by_cell_;
};

}  // namespace

WeldedCorners WeldCorners(const PatchSet& patches) {
  const Bounds bounds = BoundsOf(patches);
  VertexGrid grid(bounds.low, kWeldShare * bounds.Diagonal());
  std::unordered_map<Vec3, int32_t, PointHash> known;
  WeldedCorners welded;
  welded.vertex.resize(patches.corners.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const Vec3 p = patches.corners[i][corner];
      const auto [found, is_new] = known.try_emplace(p, 0);
      if (is_new) found->second = grid.FindOrAdd(p);
      welded.vertex[i][corner] = found->second;
    }
  }
  welded.vertex_count = grid.count();
  return welded;
}

}  // namespace lambert

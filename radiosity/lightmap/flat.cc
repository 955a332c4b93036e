// What charts ask of triangles in the plane.
#include <algorithm>
#include <cmath>

#include "radiosity/lightmap/chart.h"

namespace lambert {
namespace {

// Samples this near to an edge, as a share of the triangle, may be rounding.
constexpr double kInside = 1e-4;
// Cells of the grid for each triangle.
constexpr double kCellsPerTriangle = 4;
constexpr int kMostCells = 2048;  // a side
// Points of a triangle: the inner ones of a grid of weights in sixths.
constexpr int kWeightSteps = 6;

struct Box2 {
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
  void Add(const FlatTriangle& triangle) {
    for (const Point2& p : triangle) {
      for (int axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
  }
};

// Which triangles may hold a point: those whose boxes meet its cell.
class Cells {
 public:
  explicit Cells(const std::vector<FlatTriangle>& triangles) : triangles_(triangles) {
    for (const FlatTriangle& triangle : triangles) box_.Add(triangle);
    const double wanted = std::sqrt(kCellsPerTriangle * static_cast<double>(triangles.size()));
    side_ = std::clamp(static_cast<int>(wanted), 1, kMostCells);
    members_.resize(static_cast<size_t>(side_) * side_);
    for (size_t t = 0; t < triangles.size(); ++t) {
      Box2 box;
      box.Add(triangles[t]);
      const auto [x0, y0] = CellOf(box.low);
      const auto [x1, y1] = CellOf(box.high);
      for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) members_[Index({x, y})].push_back(static_cast<int32_t>(t));
      }
    }
  }

  // Whether `p` lies inside a triangle other than `own`.
  bool InAnother(Point2 p, int32_t own) const {
    for (int32_t t : members_[Index(CellOf(p))]) {
      if (t == own) continue;
      const Vec3 w = WeightsAt(triangles_[t], p);
      if (std::min({w.x, w.y, w.z}) > kInside) return true;
    }
    return false;
  }

 private:
  std::array<int, 2> CellOf(Point2 p) const {
    std::array<int, 2> cell{};
    for (int axis = 0; axis < 2; ++axis) {
      const double size = box_.high[axis] - box_.low[axis];
      const double place = size > 0 ? (p[axis] - box_.low[axis]) / size * side_ : 0;
      cell[axis] = std::clamp(static_cast<int>(place), 0, side_ - 1);
    }
    return cell;
  }
  size_t Index(std::array<int, 2> cell) const {
    return static_cast<size_t>(cell[1]) * side_ + cell[0];
  }

  const std::vector<FlatTriangle>& triangles_;
  Box2 box_;
  int side_ = 1;
  std::vector<std::vector<int32_t>> members_;
};

}  // namespace

Vec3 WeightsAt(const FlatTriangle& t, Point2 p) {
  const double ux = t[1][0] - t[0][0], uy = t[1][1] - t[0][1];
  const double vx = t[2][0] - t[0][0], vy = t[2][1] - t[0][1];
  const double px = p[0] - t[0][0], py = p[1] - t[0][1];
  const double area = ux * vy - uy * vx;
  const double v = (px * vy - py * vx) / area, w = (ux * py - uy * px) / area;
  return {1 - v - w, v, w};
}

bool Overlap(const std::vector<FlatTriangle>& triangles) {
  const Cells cells(triangles);
  for (size_t t = 0; t < triangles.size(); ++t) {
    for (int i = 1; i < kWeightSteps - 1; ++i) {
      for (int j = 1; i + j < kWeightSteps; ++j) {
        const double b = static_cast<double>(i) / kWeightSteps;
        const double c = static_cast<double>(j) / kWeightSteps;
        Point2 p;
        for (int axis = 0; axis < 2; ++axis) {
          p[axis] = (1 - b - c) * triangles[t][0][axis] + b * triangles[t][1][axis] +
                    c * triangles[t][2][axis];
        }
        if (cells.InAnother(p, static_cast<int32_t>(t))) return true;
      }
    }
  }
  return false;
}

}  // namespace lambert

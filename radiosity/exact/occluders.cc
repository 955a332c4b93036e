#include "radiosity/exact/occluders.h"

#include <algorithm>
#include <cmath>

#include "radiosity/core/bounds.h"

namespace lambert {
namespace {

constexpr int kLeafSize = 4;
constexpr double kTolerance =
    1e-6;  // of the scene's diagonal: twice the height at which rays start

Bounds BoundsOf(const std::vector<Triangle>& triangles, size_t begin, size_t end) {
  Bounds bounds{triangles[begin][0], triangles[begin][0]};
  for (size_t k = begin; k < end; ++k) {
    for (const Vec3& p : triangles[k]) bounds.Add(p);
  }
  return bounds;
}

bool HasBothSides(const Plane& plane, const std::vector<Triangle>& triangles, double tolerance) {
  bool front = false, back = false;
  for (const Triangle& triangle : triangles) {
    for (const Vec3& p : triangle) {
      const double height = plane.Height(p);
      front |= height > tolerance;
      back |= height < -tolerance;
    }
    if (front && back) return true;
  }
  return false;
}

}  // namespace

// The convex hull of two parts, as the planes that bound it; it lies behind each of them.
struct Occluders::Shaft {
  std::array<Vec3, 8> points;
  int point_count = 0;
  std::array<Plane, 34> planes;
  int plane_count = 0;

  Shaft(const Polygon& a, const Polygon& b, double tolerance) {
    for (int k = 0; k < a.size; ++k) points[point_count++] = a.corners[k];
    for (int k = 0; k < b.size; ++k) points[point_count++] = b.corners[k];
    AddPlane(a.corners[0], a.corners[1], a.corners[2], tolerance);
    AddPlane(b.corners[0], b.corners[1], b.corners[2], tolerance);
    AddSides(a, b, tolerance);
    AddSides(b, a, tolerance);
  }

  // The planes through an edge of `a` and a corner of `b` that have all else on one side.
  void AddSides(const Polygon& a, const Polygon& b, double tolerance) {
    for (int k = 0; k < a.size; ++k) {
      for (int l = 0; l < b.size; ++l) {
        AddPlane(a.corners[k], a.corners[(k + 1) % a.size], b.corners[l], tolerance);
      }
    }
  }

  void AddPlane(Vec3 p, Vec3 q, Vec3 r, double tolerance) {
    const Vec3 across = Cross(q - p, r - p);
    const double length = std::sqrt(Dot(across, across));
    if (!(length > tolerance * tolerance)) return;
    Plane plane{across / length, 0};
    plane.offset = Dot(plane.normal, p);
    bool front = false, back = false;
    for (int k = 0; k < point_count; ++k) {
      const double height = plane.Height(points[k]);
      front |= height > tolerance;
      back |= height < -tolerance;
      if (front && back) return;
    }
    planes[plane_count++] = front ? Plane{-plane.normal, -plane.offset} : plane;
  }

  bool Misses(const Box& box, double tolerance) const {
    for (int k = 0; k < plane_count; ++k) {
      const Vec3& n = planes[k].normal;
      const double reach =
          std::fabs(n.x) * box.half.x + std::fabs(n.y) * box.half.y + std::fabs(n.z) * box.half.z;
      if (planes[k].Height(box.center) - reach >= -tolerance) return true;
    }
    return false;
  }
};

Occluders::Occluders(const PatchSet& patches) {
  std::vector<Triangle> all;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!patches.is_back[i]) all.push_back(patches.corners[i]);
  }
  const Bounds bounds = BoundsOf(all, 0, all.size());
  tolerance_m_ = kTolerance * bounds.Diagonal();
  for (const Triangle& triangle : all) {
    if (HasBothSides(PlaneOf(triangle), all, tolerance_m_)) triangles_.push_back(triangle);
  }
  if (!triangles_.empty()) Build(0, size());
}

int Occluders::Build(int begin, int end) {
  const Bounds bounds = BoundsOf(triangles_, begin, end);
  const int node = static_cast<int>(nodes_.size());
  nodes_.push_back({{bounds.Center(), bounds.Size() * 0.5}, begin, end});
  if (end - begin > kLeafSize) {
    const int middle = (begin + end) / 2;
    Build(begin, middle);
    nodes_[node].right = Build(middle, end);
  }
  return node;
}

bool Occluders::Reaches(const Shaft& shaft, const Triangle& triangle) const {
  for (int k = 0; k < shaft.plane_count; ++k) {
    const Plane& plane = shaft.planes[k];
    const double low =
        std::min({plane.Height(triangle[0]), plane.Height(triangle[1]), plane.Height(triangle[2])});
    if (low >= -tolerance_m_) return false;
  }
  const Plane own = PlaneOf(triangle);
  bool front = false, back = false;
  for (int k = 0; k < shaft.point_count; ++k) {
    const double height = own.Height(shaft.points[k]);
    front |= height > tolerance_m_;
    back |= height < -tolerance_m_;
  }
  return front && back;
}

bool Occluders::SurelyClear(const Polygon& from, const Polygon& to) const {
  if (nodes_.empty()) return true;
  const Shaft shaft(from, to, tolerance_m_);
  int stack[64], depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const int index = stack[--depth];
    const Node& node = nodes_[index];
    if (shaft.Misses(node.box, tolerance_m_)) continue;
    if (node.right != 0) {
      stack[depth++] = node.right;
      stack[depth++] = index + 1;
      continue;
    }
    for (int k = node.begin; k < node.end; ++k) {
      if (Reaches(shaft, triangles_[k])) return false;
    }
  }
  return true;
}

}  // namespace lambert

#include "radiosity/pyramid/target_tree.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lambert {
namespace {

constexpr int kMaxPieces = 8;  // along an edge of a patch that fills much of the view

double Norm(Vec3 v) { return std::sqrt(Dot(v, v)); }

}  // namespace

TargetTree::TargetTree(const PatchSet& patches, const std::vector<double>& worth)
    : patches_(patches), worth_(worth) {
  normals_.reserve(patches.size());
  for (PatchIndex j = 0; j < patches.size(); ++j) normals_.push_back(PatchNormal(patches, j));
  nodes_.reserve(2 * static_cast<size_t>(patches.size()));
  if (patches.size() > 0) Build(worth, 0, patches.size());
}

int32_t TargetTree::Build(const std::vector<double>& worth, PatchIndex begin, PatchIndex end) {
  const int32_t index = static_cast<int32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  Bounds bounds{patches_.corners[begin][0], patches_.corners[begin][0]};
  for (PatchIndex j = begin; j < end; ++j) {
    for (const Vec3& p : patches_.corners[j]) bounds.Add(p);
    const double weight = worth[j] * patches_.area_m2[j];
    node.worth += weight;
    node.normal = node.normal + weight * normals_[j];
  }
  node.center = bounds.Center();
  node.radius = Norm(bounds.Size()) * 0.5;
  if (end - begin == 1) {
    node.patch = begin;
  } else {
    const PatchIndex middle = begin + (end - begin) / 2;
    Build(worth, begin, middle);
    node.right = Build(worth, middle, end);
  }
  nodes_[index] = node;
  return index;
}

std::vector<double> TargetTree::Moments(const LocalFrame& frame, const HemisphereCells& cells,
                                        double opening) const {
  std::vector<double> moments(cells.size());
  int32_t open[64];  // halving 2^31 patches goes 31 deep
  int depth = 0;
  if (!nodes_.empty()) open[depth++] = 0;
  while (depth > 0) {
    const int32_t index = open[--depth];
    const Node& node = nodes_[index];
    if (!(node.worth > 0)) continue;
    const Vec3 to = node.center - frame.origin;
    const double height = Dot(to, frame.z);
    if (height <= -node.radius) continue;  // wholly below the horizon
    const double distance2 = Dot(to, to);
    if (node.radius * node.radius > opening * opening * distance2) {
      if (node.patch >= 0) {
        AddPatch(node.patch, frame, cells, opening, moments);
      } else {
        open[depth++] = node.right;
        open[depth++] = index + 1;
      }
      continue;
    }
    const Vec3 local = frame.ToLocal(node.center);
    const int cell = cells.Locate(local);
    if (cell < 0) continue;
    const double distance = std::sqrt(distance2);
    // Mean of max(0, cosine) over the normals below: the cosine itself where they agree, a quarter
    // where they point everywhere.
    const double mean = -Dot(node.normal, to) / (distance * node.worth);
    const double spread = 1 - Dot(node.normal, node.normal) / (node.worth * node.worth);
    const double facing = 0.5 * (mean + std::sqrt(mean * mean + 0.25 * std::max(0.0, spread)));
    moments[cell] += node.worth * facing * (local.z / distance) / (std::numbers::pi * distance2);
  }
  return moments;
}

void TargetTree::AddPatch(PatchIndex j, const LocalFrame& frame, const HemisphereCells& cells,
                          double opening, std::vector<double>& moments) const {
  const auto& corner = patches_.corners[j];
  const Vec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
  const Vec3 centroid = corner[0] + (e1 + e2) / 3;
  const double size = std::sqrt(std::max(Dot(e1, e1), Dot(e2, e2)));
  const double distance = std::max(Norm(centroid - frame.origin) - 0.5 * size, 1e-3 * size);
  const int n = std::clamp(static_cast<int>(0.5 * size / (opening * distance)) + 1, 1, kMaxPieces);
  const double area = patches_.area_m2[j] / (n * n);
  // n^2 equal triangles: in row `a`, those that point up and, between them, those that point down.
  for (int a = 0; a < n; ++a) {
    for (int k = 0; k < 2 * (n - a) - 1; ++k) {
      const double third = k % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
      const Vec3 point = corner[0] + e1 * ((a + third) / n) + e2 * ((k / 2 + third) / n);
      const Vec3 to = point - frame.origin;
      const double height = Dot(to, frame.z), toward = -Dot(to, normals_[j]);
      if (!(height > 0) || !(toward > 0)) continue;
      const int cell = cells.Locate(frame.ToLocal(point));
      if (cell < 0) continue;
      const double d2 = Dot(to, to);
      // cos cos A / (pi d^2 + A): a piece that is near fills at most all of the view.
      moments[cell] += worth_[j] * area * (height * toward / d2) / (std::numbers::pi * d2 + area);
    }
  }
}

}  // namespace lambert

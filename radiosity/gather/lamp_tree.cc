#include "radiosity/gather/lamp_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "radiosity/exact/form_factor.h"
#include "radiosity/pyramid/spherical_triangle.h"

namespace lambert {
namespace {

// Where a lamp covers more than that, places on it are even in solid angle [sr]: evenness in area
// would send most rays to where the lamp is far. Below, both are alike, and area keeps its digits.
constexpr double kLargeSr = 0.02;

// A patch as a point sees it: unit directions to its corners.
struct SeenTriangle {
  std::array<Vec3, 3> toward;
  double solid_angle = 0;  // [sr]; 0: nothing is seen
  double mean_cosine = 0;  // over the corners, those below the horizon taken as on it
};

SeenTriangle See(const PatchSet& patches, PatchIndex lamp, Vec3 point, Vec3 normal) {
  SeenTriangle seen;
  const std::array<Vec3, 3>& corners = patches.corners[lamp];
  for (int k = 0; k < 3; ++k) {
    const Vec3 d = corners[k] - point;
    const double distance = std::sqrt(Dot(d, d));
    if (!(distance > 0)) return seen;
    seen.toward[k] = d / distance;
    seen.mean_cosine += std::max(0.0, Dot(seen.toward[k], normal)) / 3;
  }
  seen.solid_angle = SolidAngleFrom(point, corners);
  return seen;
}

double Distance2(const Bounds& bounds, Vec3 p) {
  const Vec3 nearest{std::clamp(p.x, bounds.low.x, bounds.high.x),
                     std::clamp(p.y, bounds.low.y, bounds.high.y),
                     std::clamp(p.z, bounds.low.z, bounds.high.z)};
  return Dot(nearest - p, nearest - p);
}

// Whether some corner of the box lies above the plane of the point.
bool RisesAbove(const Bounds& bounds, Vec3 point, Vec3 normal) {
  const Vec3 highest{normal.x > 0 ? bounds.high.x : bounds.low.x,
                     normal.y > 0 ? bounds.high.y : bounds.low.y,
                     normal.z > 0 ? bounds.high.z : bounds.low.z};
  return Dot(highest - point, normal) > 0;
}

}  // namespace

LampTree::LampTree(const PatchSet& patches) : patches_(patches) {
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (Mean(patches.exitance_lm_per_m2[i]) > 0) lamps_.push_back(i);
  }
  nodes_.reserve(2 * lamps_.size());
  if (!lamps_.empty()) Build(0, static_cast<int32_t>(lamps_.size()));
}

int32_t LampTree::Build(int32_t begin, int32_t end) {
  const auto self = static_cast<int32_t>(nodes_.size());
  nodes_.emplace_back();
  Node node;
  if (end - begin == 1) {
    node.lamp = begin;
    const PatchIndex patch = lamps_[begin];
    node.bounds = {patches_.corners[patch][0], patches_.corners[patch][0]};
    for (const Vec3& corner : patches_.corners[patch]) node.bounds.Add(corner);
    node.flux_lm = Mean(patches_.exitance_lm_per_m2[patch]) * patches_.area_m2[patch];
  } else {
    const int32_t middle = begin + (end - begin) / 2;
    node.left = Build(begin, middle);
    node.right = Build(middle, end);
    node.bounds = nodes_[node.left].bounds;
    node.bounds.Add(nodes_[node.right].bounds);
    node.flux_lm = nodes_[node.left].flux_lm + nodes_[node.right].flux_lm;
  }
  nodes_[self] = node;
  return self;
}

double LampTree::LampWorth(PatchIndex lamp, Vec3 point, Vec3 normal) const {
  const SeenTriangle seen = See(patches_, lamp, point, normal);
  return Mean(patches_.exitance_lm_per_m2[lamp]) * seen.solid_angle * seen.mean_cosine;
}

// In lux, about; 0 only where nothing can arrive.
double LampTree::Worth(int32_t node, Vec3 point, Vec3 normal) const {
  const Node& n = nodes_[node];
  if (n.lamp >= 0) return LampWorth(lamps_[n.lamp], point, normal);
  if (!RisesAbove(n.bounds, point, normal)) return 0;
  // A part of the tree around the point may hold a lamp close to it: better too many rays there
  // than a few that carry much. Such parts are also the first to be opened by CutFor.
  const double near = n.bounds.Diagonal() / 8;
  return n.flux_lm / std::max(Distance2(n.bounds, point), near * near);
}

LampTree::Cut LampTree::CutFor(Vec3 point, Vec3 normal) const {
  Cut cut(*this, point, normal);
  if (empty()) return cut;
  std::vector<std::pair<double, int32_t>> open{{Worth(0, point, normal), 0}}, leaves;
  while (!open.empty() && open.size() + leaves.size() < kMostPieces) {
    std::pop_heap(open.begin(), open.end());
    const auto [worth, node] = open.back();
    open.pop_back();
    if (worth == 0) continue;
    if (nodes_[node].lamp >= 0) {
      leaves.emplace_back(worth, node);
      continue;
    }
    for (int32_t child : {nodes_[node].left, nodes_[node].right}) {
      open.emplace_back(Worth(child, point, normal), child);
      std::push_heap(open.begin(), open.end());
    }
  }
  leaves.insert(leaves.end(), open.begin(), open.end());
  // By place, so that neighbouring numbers choose neighbouring lamps.
  std::sort(leaves.begin(), leaves.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  double sum = 0;
  for (const auto& [worth, node] : leaves) {
    if (worth == 0) continue;
    sum += worth;
    cut.pieces_.push_back(node);
    cut.until_.push_back(sum);
  }
  return cut;
}

LampTree::Choice LampTree::Cut::Pick(double& xi) const {
  const double total = until_.back(), at = xi * total;
  const auto after = std::upper_bound(until_.begin(), until_.end() - 1, at);
  const double from = after == until_.begin() ? 0 : *(after - 1), share = *after - from;
  constexpr double kLast = 1 - 0x1p-53;
  xi = std::clamp((at - from) / share, 0.0, kLast);
  Choice choice{kNoPatch, share / total};
  int32_t node = pieces_[after - until_.begin()];
  while (tree_.nodes_[node].lamp < 0) {
    const Node& n = tree_.nodes_[node];
    const double left = tree_.Worth(n.left, point_, normal_);
    const double right = tree_.Worth(n.right, point_, normal_);
    if (left + right == 0) return choice;
    const double to_left = left / (left + right);
    const bool goes_left = xi < to_left;
    xi = goes_left ? xi / to_left : (xi - to_left) / (1 - to_left);
    xi = std::clamp(xi, 0.0, kLast);
    choice.probability *= goes_left ? to_left : 1 - to_left;
    node = goes_left ? n.left : n.right;
  }
  choice.lamp = tree_.lamps_[tree_.nodes_[node].lamp];
  return choice;
}

LampSample SampleLamp(const PatchSet& patches, PatchIndex lamp, Vec3 point, Vec3 normal, double xi1,
                      double xi2) {
  LampSample sample;
  const SeenTriangle seen = See(patches, lamp, point, normal);
  if (seen.solid_angle == 0) return sample;
  const Rgb radiance = patches.exitance_lm_per_m2[lamp] / std::numbers::pi;
  const std::array<Vec3, 3>& corners = patches.corners[lamp];
  const Vec3 across = Cross(corners[1] - corners[0], corners[2] - corners[0]);  // 2 area normal
  if (seen.solid_angle > kLargeSr) {
    const Vec3 way = SampleSolidAngle(
        MakeArvoConstants(seen.toward[0], seen.toward[2], seen.toward[1]), xi1, xi2);
    const double facing = Dot(across, way);
    if (!(facing < 0)) return sample;
    sample.to_lamp = way * (Dot(across, corners[0] - point) / facing);
    sample.irradiance_lx = radiance * (seen.solid_angle * std::max(0.0, Dot(way, normal)));
  } else {
    const double root = std::sqrt(xi1);
    sample.to_lamp = corners[0] * (1 - root) + corners[1] * (root * (1 - xi2)) +
                     corners[2] * (root * xi2) - point;
    const double d2 = Dot(sample.to_lamp, sample.to_lamp);
    if (!(d2 > 0)) return sample;
    // cos(theta) cos(theta') area / d^2.
    sample.irradiance_lx = radiance * (std::max(0.0, Dot(sample.to_lamp, normal)) *
                                       std::max(0.0, -Dot(sample.to_lamp, across)) / (2 * d2 * d2));
  }
  return sample;
}

}  // namespace lambert

#include "radiosity/output/smooth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "radiosity/output/weld.h"

namespace lambert {
namespace {

// Height of the ray between two centres over the surface, as a share of its length: under it pass
// only things too low to cast a visible shadow.
constexpr double kLiftShare = 0.02;
// The same at least, in trace coordinates: well above the float32 rounding of positions.
constexpr double kLeastLift = 4e-6;
// Patches whose normals agree to this cosine lie in one plane.
constexpr double kFlatCosine = 0.9999;

// Sides that more patches share are left sharp: no surface looks so, and pairs grow as the square.
constexpr size_t kCrowdedSide = 16;

// One side of one patch, from `from` to the next corner of the patch.
struct Side {
  int32_t low, high;  // welded vertices, low < high
  PatchIndex patch;
  int from;           // corner
  bool forward;       // runs from `low` to `high`
};

class UnionFind {
 public:
  explicit UnionFind(size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int32_t Find(int32_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  void Join(int32_t a, int32_t b) { parent_[Find(a)] = Find(b); }

 private:
  std::vector<int32_t> parent_;
};

std::vector<Side> SortedSides(const WeldedCorners& welded) {
  std::vector<Side> sides;
  sides.reserve(3 * welded.vertex.size());
  for (size_t i = 0; i < welded.vertex.size(); ++i) {
    for (int from = 0; from < 3; ++from) {
      const int32_t a = welded.vertex[i][from], b = welded.vertex[i][(from + 1) % 3];
      if (a == b) continue;
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<PatchIndex>(i), from, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.patch < b.patch;
  });
  return sides;
}

// Decides which patches that share a side are neighbours.
class Neighbourhood {
 public:
  Neighbourhood(const PatchSet& patches, const RayScene& scene)
      : patches_(patches),
        scene_(scene),
        least_cosine_(std::cos(kSmoothAngle * std::numbers::pi / 180)) {}

  bool Joined(const Side& a, const Side& b) const {
    if (a.forward == b.forward) return false;
    const Vec3 normal_a = PatchNormal(patches_, a.patch), normal_b = PatchNormal(patches_, b.patch);
    const double cosine = Dot(normal_a, normal_b);
    if (cosine < least_cosine_) return false;
    const Vec3 center_a = PatchCentroid(patches_, a.patch);
    const Vec3 center_b = PatchCentroid(patches_, b.patch);
    const double lift =
        std::max(kLiftShare * Length(center_b - center_a), kLeastLift / scene_.scale());
    const Vec3 from = center_a + normal_a * lift, to = center_b + normal_b * lift;
    // Over a bend the way goes by the middle of the side: a straight one would cut the surface.
    const auto& corners = patches_.corners[a.patch];
    const Vec3 middle = (corners[a.from] + corners[(a.from + 1) % 3]) * 0.5;
    const Vec3 over = middle + Normalized(normal_a + normal_b) * lift;
    // Rays pass through the backs of one-sided patches, so each way is tried from both its ends.
    const bool flat = cosine > kFlatCosine;
    return flat ? Free(from, to, a, b) && Free(to, from, a, b)
                : Free(from, over, a, b) && Free(over, from, a, b) && Free(over, to, a, b) &&
                      Free(to, over, a, b);
  }

 private:
  bool Free(Vec3 from, Vec3 to, const Side& a, const Side& b) const {
    const Vec3 way = to - from;
    const PictureHit hit = scene_.Cast(from, way);
    return hit.patch == kNoPatch || hit.distance_m >= Length(way) || hit.patch == a.patch ||
           hit.patch == b.patch;
  }

  const PatchSet& patches_;
  const RayScene& scene_;
  const double least_cosine_;
};

// Angle of patch i at a corner [rad].
double CornerAngle(const PatchSet& patches, PatchIndex i, int corner) {
  const auto& p = patches.corners[i];
  const Vec3 u = p[(corner + 1) % 3] - p[corner], v = p[(corner + 2) % 3] - p[corner];
  return std::atan2(Length(Cross(u, v)), Dot(u, v));
}

}  // namespace

CornerFans FindCornerFans(const PatchSet& patches, const RayScene& scene) {
  const std::vector<Side> sides = SortedSides(WeldCorners(patches));
  const Neighbourhood neighbourhood(patches, scene);
  UnionFind fans(3 * static_cast<size_t>(patches.size()));
  auto join = [&](const Side& a, const Side& b) {
    // The end of one side is the beginning of the other.
    fans.Join(3 * a.patch + a.from, 3 * b.patch + (b.from + 1) % 3);
    fans.Join(3 * a.patch + (a.from + 1) % 3, 3 * b.patch + b.from);
  };
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high) {
      ++end;
    }
    if (end - begin > kCrowdedSide) continue;
    for (size_t a = begin; a < end; ++a) {
      for (size_t b = a + 1; b < end; ++b) {
        if (neighbourhood.Joined(sides[a], sides[b])) join(sides[a], sides[b]);
      }
    }
  }
  CornerFans result;
  result.fan.resize(patches.corners.size());
  std::vector<int32_t> number(3 * patches.corners.size(), -1);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      int32_t& fan = number[fans.Find(3 * i + corner)];
      if (fan < 0) fan = result.fan_count++;
      result.fan[i][corner] = fan;
    }
  }
  return result;
}

std::vector<Rgb> AverageOverFans(const PatchSet& patches, const CornerFans& fans,
                                 const std::vector<Rgb>& values) {
  std::vector<Rgb> sum(fans.fan_count);
  std::vector<double> weight(fans.fan_count, 0);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const double angle = CornerAngle(patches, i, corner);
      const int32_t fan = fans.fan[i][corner];
      sum[fan] = sum[fan] + values[i] * angle;
      weight[fan] += angle;
    }
  }
  for (int32_t fan = 0; fan < fans.fan_count; ++fan) {
    if (weight[fan] > 0) sum[fan] = sum[fan] / weight[fan];
  }
  return sum;
}

}  // namespace lambert

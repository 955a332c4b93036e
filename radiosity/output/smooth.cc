#include "radiosity/output/smooth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "radiosity/output/weld.h"

namespace lambert {
namespace {

// Where a patch is looked at near its corner: this part of the way to its centre.
constexpr double kNearCorner = 0.05;
// Height of a ray over the surface, as a share of the way from corner to centre: under it pass only
// things too low to cast a visible shadow.
constexpr double kLiftShare = 0.02;
// The same at least, in trace coordinates: well above the float32 rounding of positions.
constexpr double kLeastLift = 4e-6;
// Patches whose normals agree to this cosine lie in one plane.
constexpr double kFlatCosine = 0.9999;
// A patch with less than this share of the light beyond an obstacle lies under it, where nobody looks;
// what is behind a partition gets more.
constexpr double kCoveredShare = 1e-3;
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

// Looks along the surface.
class Surveyor {
 public:
  Surveyor(const PatchSet& patches, const RayScene& scene)
      : patches_(patches),
        scene_(scene),
        least_cosine_(std::cos(kSmoothAngle * std::numbers::pi / 180)) {}

  // True where two sides belong to one smooth surface, whatever stands on it.
  bool SameSurface(const Side& a, const Side& b) const {
    return a.forward != b.forward && Bend(a, b) >= least_cosine_;
  }

  // True where the patches of two sides see each other near the corner `corner_a` of a, an end of its
  // side. Requires: SameSurface(a, b).
  bool JoinedAt(const Side& a, int corner_a, const Side& b, int corner_b) const {
    const Vec3 from = NearCorner(a.patch, corner_a), to = NearCorner(b.patch, corner_b);
    if (Bend(a, b) > kFlatCosine) return Free(from, to, a.patch, b.patch);
    // Over a bend the way goes by the side: a straight one would cut the surface.
    const auto& corners = patches_.corners[a.patch];
    const Vec3 middle = (corners[a.from] + corners[(a.from + 1) % 3]) * 0.5;
    const Vec3 on_side = corners[corner_a] + (middle - corners[corner_a]) * kNearCorner;
    const Vec3 normal = PatchNormal(patches_, a.patch) + PatchNormal(patches_, b.patch);
    const Vec3 over = on_side + Normalized(normal) * Lift(a.patch, corner_a);
    return Free(from, over, a.patch, b.patch) && Free(over, to, a.patch, b.patch);
  }

  bool CenterSees(PatchIndex i, int corner) const {
    const Vec3 center =
        PatchCentroid(patches_, i) + PatchNormal(patches_, i) * Lift(i, corner);
    return Free(center, NearCorner(i, corner), i, i);
  }

 private:
  double Bend(const Side& a, const Side& b) const {
    return Dot(PatchNormal(patches_, a.patch), PatchNormal(patches_, b.patch));
  }

  double Lift(PatchIndex i, int corner) const {
    const double way = Length(PatchCentroid(patches_, i) - patches_.corners[i][corner]);
    return std::max(kLiftShare * way, kLeastLift / scene_.scale());
  }

  Vec3 NearCorner(PatchIndex i, int corner) const {
    const Vec3 p = patches_.corners[i][corner];
    return p + (PatchCentroid(patches_, i) - p) * kNearCorner +
           PatchNormal(patches_, i) * Lift(i, corner);
  }

  // Rays pass through the backs of one-sided patches, so the way is tried from both its ends.
  bool Free(Vec3 from, Vec3 to, PatchIndex a, PatchIndex b) const {
    return FreeAlong(from, to, a, b) && FreeAlong(to, from, a, b);
  }

  bool FreeAlong(Vec3 from, Vec3 to, PatchIndex a, PatchIndex b) const {
    const Vec3 way = to - from;
    const PictureHit hit = scene_.Cast(from, way);
    return hit.patch == kNoPatch || hit.distance_m >= Length(way) || hit.patch == a ||
           hit.patch == b;
  }

  const PatchSet& patches_;
  const RayScene& scene_;
  const double least_cosine_;
};

// Joins the corners at both ends of two sides, where the patches see each other there.
void JoinSides(const Surveyor& surveyor, const Side& a, const Side& b, UnionFind& corners) {
  if (!surveyor.SameSurface(a, b)) return;
  // The end of one side is the beginning of the other.
  const int a_ends[] = {a.from, (a.from + 1) % 3};
  const int b_ends[] = {(b.from + 1) % 3, b.from};
  for (int end = 0; end < 2; ++end) {
    const int32_t corner_a = 3 * a.patch + a_ends[end], corner_b = 3 * b.patch + b_ends[end];
    if (corners.Find(corner_a) == corners.Find(corner_b)) continue;
    if (surveyor.JoinedAt(a, a_ends[end], b, b_ends[end])) corners.Join(corner_a, corner_b);
  }
}

// Mean of the patches of every fan that see their corner, weighted by area: the variance of a patch's
// irradiance goes as 1 / area, so slivers and crumbs of a mesh do not speckle the picture.
struct FanMeans {
  std::vector<Rgb> mean;
  std::vector<double> weight;  // 0: no patch speaks for this fan
};

FanMeans AverageOverFans(const PatchSet& patches, const CornerFans& fans,
                         const std::vector<Rgb>& values) {
  FanMeans means{std::vector<Rgb>(fans.fan_count), std::vector<double>(fans.fan_count, 0)};
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      if (fans.cut_off[i][corner]) continue;
      const int32_t fan = fans.fan[i][corner];
      means.mean[fan] = means.mean[fan] + values[i] * patches.area_m2[i];
      means.weight[fan] += patches.area_m2[i];
    }
  }
  for (int32_t fan = 0; fan < fans.fan_count; ++fan) {
    if (means.weight[fan] > 0) means.mean[fan] = means.mean[fan] / means.weight[fan];
  }
  return means;
}

// Settles the corners of a patch that something stands on. `own` is the irradiance of the patch as a
// whole, `corners` holds the means of its fans.
void SettleCutOffCorners(const std::array<bool, 3>& cut_off, Rgb own, std::array<Rgb, 3>& corners) {
  Rgb beyond;  // mean of what lies behind the obstacle
  int count = 0;
  for (int corner = 0; corner < 3; ++corner) {
    if (!cut_off[corner]) continue;
    beyond = beyond + corners[corner];
    ++count;
  }
  beyond = beyond / count;
  const bool covered = Mean(own) < kCoveredShare * Mean(beyond);
  for (int corner = 0; corner < 3; ++corner) {
    if (cut_off[corner] != covered) corners[corner] = covered ? beyond : own;
  }
}

}  // namespace

CornerFans FindCornerFans(const PatchSet& patches, const RayScene& scene) {
  const std::vector<Side> sides = SortedSides(WeldCorners(patches));
  const Surveyor surveyor(patches, scene);
  UnionFind corners(3 * static_cast<size_t>(patches.size()));
  for (size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high) {
      ++end;
    }
    if (end - begin > kCrowdedSide) continue;
    for (size_t a = begin; a < end; ++a) {
      for (size_t b = a + 1; b < end; ++b) JoinSides(surveyor, sides[a], sides[b], corners);
    }
  }
  CornerFans fans;
  fans.fan.resize(patches.corners.size());
  fans.cut_off.resize(patches.corners.size());
  std::vector<int32_t> number(3 * patches.corners.size(), -1);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      int32_t& fan = number[corners.Find(3 * i + corner)];
      if (fan < 0) fan = fans.fan_count++;
      fans.fan[i][corner] = fan;
      fans.cut_off[i][corner] = !surveyor.CenterSees(i, corner);
    }
  }
  return fans;
}

std::vector<std::array<Rgb, 3>> SmoothIrradiance(const PatchSet& patches, const CornerFans& fans,
                                                 const std::vector<Rgb>& irradiance_lx) {
  const FanMeans means = AverageOverFans(patches, fans, irradiance_lx);
  std::vector<std::array<Rgb, 3>> smooth(irradiance_lx.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const int32_t fan = fans.fan[i][corner];
      smooth[i][corner] = means.weight[fan] > 0 ? means.mean[fan] : irradiance_lx[i];
    }
    const std::array<bool, 3>& cut_off = fans.cut_off[i];
    if (cut_off[0] || cut_off[1] || cut_off[2]) {
      SettleCutOffCorners(cut_off, irradiance_lx[i], smooth[i]);
    }
  }
  return smooth;
}

}  // namespace lambert

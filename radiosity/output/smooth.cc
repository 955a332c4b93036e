#include "radiosity/output/smooth.h"

#include <algorithm>

#include "radiosity/core/disjoint_sets.h"
#include "radiosity/output/weld.h"

namespace lambert {
namespace {

// Sides that more patches share are left sharp: no surface looks so, and pairs grow as the square.
constexpr size_t kCrowdedSide = 16;

// One side of one patch, from `from` to the next corner of the patch.
struct Side {
  int32_t low, high;  // welded vertices, low < high
  PatchIndex patch;
  int from;      // corner
  bool forward;  // runs from `low` to `high`
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

// Joins the corners at both ends of two sides, where the patches see each other there.
void JoinSides(const Surveyor& surveyor, const Side& a, const Side& b, DisjointSets& corners) {
  if (a.forward == b.forward || !surveyor.NearlyCoplanar(a.patch, b.patch)) return;
  // The end of one side is the beginning of the other.
  const int a_ends[] = {a.from, (a.from + 1) % 3};
  const int b_ends[] = {(b.from + 1) % 3, b.from};
  for (int end = 0; end < 2; ++end) {
    const int32_t corner_a = 3 * a.patch + a_ends[end], corner_b = 3 * b.patch + b_ends[end];
    if (corners.Find(corner_a) == corners.Find(corner_b)) continue;
    if (surveyor.JoinedAt(a.patch, a_ends[end], a_ends[1 - end], b.patch, b_ends[end])) {
      corners.Join(corner_a, corner_b);
    }
  }
}

// Mean of every fan over the patches that speak for it, weighted by exposed area: the variance of a
// patch's irradiance goes as 1 / area, so slivers and crumbs of a mesh do not speckle the picture.
struct FanMeans {
  std::vector<Rgb> mean;
  std::vector<double> weight;  // 0: no patch speaks for this fan
};

FanMeans AverageOverFans(const PatchSet& patches, const CornerFans& fans,
                         const std::vector<Rgb>& values) {
  FanMeans means{std::vector<Rgb>(fans.fan_count), std::vector<double>(fans.fan_count, 0)};
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const PatchSurvey& survey = fans.survey[i];
    const double weight = patches.area_m2[i] * survey.exposed_share;
    for (int corner = 0; corner < 3; ++corner) {
      if (survey.corners[corner] != CornerState::kOpen) continue;
      const int32_t fan = fans.fan[i][corner];
      means.mean[fan] = means.mean[fan] + values[i] * weight;
      means.weight[fan] += weight;
    }
  }
  for (int32_t fan = 0; fan < fans.fan_count; ++fan) {
    if (means.weight[fan] > 0) means.mean[fan] = means.mean[fan] / means.weight[fan];
  }
  return means;
}

// Gives hidden corners the mean of the others, so that what can be seen of the patch stays even.
void FillHiddenCorners(const PatchSurvey& survey, std::array<Rgb, 3>& corners) {
  Rgb sum;
  int visible = 0;
  for (int corner = 0; corner < 3; ++corner) {
    if (survey.corners[corner] == CornerState::kHidden) continue;
    sum = sum + corners[corner];
    ++visible;
  }
  if (visible == 0 || visible == 3) return;
  for (int corner = 0; corner < 3; ++corner) {
    if (survey.corners[corner] == CornerState::kHidden) corners[corner] = sum / visible;
  }
}

}  // namespace

CornerFans FindCornerFans(const PatchSet& patches, const RayScene& scene) {
  const std::vector<Side> sides = SortedSides(WeldCorners(patches));
  const Surveyor surveyor(patches, scene);
  DisjointSets corners(3 * static_cast<size_t>(patches.size()));
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
  std::vector<int32_t> number(3 * patches.corners.size(), -1);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      int32_t& fan = number[corners.Find(3 * i + corner)];
      if (fan < 0) fan = fans.fan_count++;
      fans.fan[i][corner] = fan;
    }
    fans.survey.push_back(surveyor.Survey(i));
  }
  return fans;
}

std::vector<std::array<Rgb, 3>> SmoothIrradiance(const PatchSet& patches, const CornerFans& fans,
                                                 const std::vector<Rgb>& irradiance_lx) {
  std::vector<Rgb> exposed = irradiance_lx;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const double share = fans.survey[i].exposed_share;
    if (share > 0) exposed[i] = exposed[i] / share;
  }
  const FanMeans means = AverageOverFans(patches, fans, exposed);
  std::vector<std::array<Rgb, 3>> smooth(exposed.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const PatchSurvey& survey = fans.survey[i];
    for (int corner = 0; corner < 3; ++corner) {
      const int32_t fan = fans.fan[i][corner];
      const bool of_fan = survey.corners[corner] == CornerState::kOpen && means.weight[fan] > 0;
      smooth[i][corner] = of_fan ? means.mean[fan] : exposed[i];
    }
    FillHiddenCorners(survey, smooth[i]);
  }
  return smooth;
}

}  // namespace lambert

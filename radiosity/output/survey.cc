#include "radiosity/output/survey.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
// Hits farther than this share of a way are its end.
constexpr double kNearlyAll = 0.9999;
// The exposed share is counted on the centres of kGrid^2 equal triangles.
constexpr int kGrid = 4;

}  // namespace

Surveyor::Surveyor(const PatchSet& patches, const RayScene& scene)
    : patches_(patches),
      scene_(scene),
      least_cosine_(std::cos(kSmoothAngle * std::numbers::pi / 180)) {}

bool Surveyor::NearlyCoplanar(PatchIndex a, PatchIndex b) const {
  return Dot(PatchNormal(patches_, a), PatchNormal(patches_, b)) >= least_cosine_;
}

bool Surveyor::JoinedAt(PatchIndex a, int corner_a, int other_a, PatchIndex b, int corner_b) const {
  const Vec3 from = NearCorner(a, corner_a), to = NearCorner(b, corner_b);
  const Vec3 normal_a = PatchNormal(patches_, a), normal_b = PatchNormal(patches_, b);
  if (Dot(normal_a, normal_b) > kFlatCosine) return Free(from, to, a, b);
  // Over a bend the way goes by the side: a straight one would cut the surface.
  const Vec3 corner = patches_.corners[a][corner_a], other = patches_.corners[a][other_a];
  const Vec3 over = corner + (other - corner) * (kNearCorner / 2) +
                    Normalized(normal_a + normal_b) * Lift(a, corner_a);
  return Free(from, over, a, b) && Free(over, to, a, b);
}

PatchSurvey Surveyor::Survey(PatchIndex i) const {
  const Vec3 normal = PatchNormal(patches_, i), center = PatchCentroid(patches_, i);
  std::array<bool, 3> seen;
  for (int corner = 0; corner < 3; ++corner) {
    seen[corner] = Free(center + normal * Lift(i, corner), NearCorner(i, corner), i, i);
  }
  if (seen[0] && seen[1] && seen[2]) return {};
  return SurveyClosely(i, seen);
}

// `seen`: the corners that the centre sees.
PatchSurvey Surveyor::SurveyClosely(PatchIndex i, std::array<bool, 3> seen) const {
  PatchSurvey survey;
  const double lift = Lift(i, 0);
  survey.exposed_share = ExposedShare(i, lift);
  std::array<bool, 3> within;
  for (int corner = 0; corner < 3; ++corner) within[corner] = WithinSolid(i, NearCorner(i, corner));
  // A corner that the centre does not see, past a table leg, it may see by way of another corner.
  for (int round = 0; round < 2; ++round) {
    for (int corner = 0; corner < 3; ++corner) {
      const int next = (corner + 1) % 3;
      if (seen[corner] == seen[next] || within[corner] || within[next]) continue;
      if (Free(NearCorner(i, corner), NearCorner(i, next), i, i)) seen[corner] = seen[next] = true;
    }
  }
  const Vec3 center = PatchCentroid(patches_, i) + PatchNormal(patches_, i) * lift;
  const bool center_within = WithinSolid(i, center);
  for (int corner = 0; corner < 3; ++corner) {
    if (within[corner]) {
      survey.corners[corner] = CornerState::kHidden;
    } else if (!seen[corner] && !center_within) {
      survey.corners[corner] = CornerState::kCutOff;
    }
  }
  return survey;
}

double Surveyor::Lift(PatchIndex i, int corner) const {
  const double way = Length(PatchCentroid(patches_, i) - patches_.corners[i][corner]);
  return std::max(kLiftShare * way, kLeastLift / scene_.scale());
}

Vec3 Surveyor::NearCorner(PatchIndex i, int corner) const {
  const Vec3 p = patches_.corners[i][corner];
  return p + (PatchCentroid(patches_, i) - p) * kNearCorner +
         PatchNormal(patches_, i) * Lift(i, corner);
}

// From within a solid every way out passes a side of it from the back. Two ways of three decide:
// the top of a table leg lies in the bottom of the table, and a single wall may show its back too.
bool Surveyor::WithinSolid(PatchIndex i, Vec3 point) const {
  const Vec3 normal = PatchNormal(patches_, i);
  const auto& corners = patches_.corners[i];
  const Vec3 along = Normalized(corners[1] - corners[0]);
  int leaving = 0;
  for (const Vec3& way : {normal, along, Cross(normal, along)}) {
    leaving += LeavesSolid(point, way);
  }
  return leaving >= 2;
}

// True where the first surface on a way shows it its back: looking along the way one sees past that
// surface, looking back one meets it.
bool Surveyor::LeavesSolid(Vec3 point, Vec3 way) const {
  const PictureHit ahead = scene_.Cast(point, way);
  const double scene_size = 2 / scene_.scale();
  const double distance = ahead.patch == kNoPatch ? scene_size : kNearlyAll * ahead.distance_m;
  const PictureHit behind = scene_.Cast(point + way * distance, -way);
  return behind.patch != kNoPatch && behind.distance_m < kNearlyAll * distance;
}

double Surveyor::ExposedShare(PatchIndex i, double lift) const {
  const auto& corners = patches_.corners[i];
  const Vec3 u = (corners[1] - corners[0]) / kGrid, v = (corners[2] - corners[0]) / kGrid;
  const Vec3 first = corners[0] + PatchNormal(patches_, i) * lift;
  int exposed = 0;
  for (int row = 0; row < kGrid; ++row) {
    for (int column = 0; row + column < kGrid; ++column) {
      const Vec3 cell = first + u * column + v * row;
      exposed += !WithinSolid(i, cell + (u + v) / 3);
      if (row + column + 1 < kGrid) exposed += !WithinSolid(i, cell + (u + v) * (2.0 / 3));
    }
  }
  return static_cast<double>(exposed) / (kGrid * kGrid);
}

// Rays pass through the backs of one-sided patches, so the way is tried from both its ends.
bool Surveyor::Free(Vec3 from, Vec3 to, PatchIndex a, PatchIndex b) const {
  return FreeAlong(from, to, a, b) && FreeAlong(to, from, a, b);
}

bool Surveyor::FreeAlong(Vec3 from, Vec3 to, PatchIndex a, PatchIndex b) const {
  const Vec3 way = to - from;
  const PictureHit hit = scene_.Cast(from, way);
  return hit.patch == kNoPatch || hit.distance_m >= Length(way) || hit.patch == a || hit.patch == b;
}

}  // namespace lambert

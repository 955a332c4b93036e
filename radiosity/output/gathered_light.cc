#include "radiosity/output/gathered_light.h"

#include <cstdint>

namespace lambert {
namespace {

constexpr double kInset = 1.0 / 64;  // of the way from a corner to the centroid

// The corner that speaks for a fan: that of its largest patch.
struct Speaker {
  PatchIndex patch = kNoPatch;
  int corner = 0;
};

std::vector<Speaker> FindSpeakers(const PatchSet& patches, const CornerFans& fans) {
  std::vector<Speaker> speakers(fans.fan_count);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      if (fans.survey[i].corners[corner] != CornerState::kOpen) continue;
      Speaker& speaker = speakers[fans.fan[i][corner]];
      if (speaker.patch == kNoPatch || patches.area_m2[i] > patches.area_m2[speaker.patch]) {
        speaker = {i, corner};
      }
    }
  }
  return speakers;
}

// Gives the corners for which a patch does not speak the mean of the others. False without any.
bool FillFromOpenCorners(const PatchSurvey& survey, std::array<Rgb, 3>& corners) {
  Rgb sum;
  int open = 0;
  for (int corner = 0; corner < 3; ++corner) {
    if (survey.corners[corner] != CornerState::kOpen) continue;
    sum = sum + corners[corner];
    ++open;
  }
  if (open == 0) return false;
  for (int corner = 0; corner < 3; ++corner) {
    if (survey.corners[corner] != CornerState::kOpen) corners[corner] = sum / open;
  }
  return true;
}

}  // namespace

std::vector<std::array<Vec3, 3>> SmoothNormals(const PatchSet& patches, const CornerFans& fans) {
  std::vector<Vec3> sums(fans.fan_count);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int32_t fan : fans.fan[i]) {
      sums[fan] = sums[fan] + PatchNormal(patches, i) * patches.area_m2[i];
    }
  }
  std::vector<std::array<Vec3, 3>> normals(patches.corners.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      normals[i][corner] = Normalized(sums[fans.fan[i][corner]]);
    }
  }
  return normals;
}

absl::StatusOr<std::vector<std::array<Rgb, 3>>> GatherCorners(
    const PatchSet& patches, const CornerFans& fans,
    const std::vector<std::array<Vec3, 3>>& normals, const GatherFunction& gather) {
  GatherPoints points;
  std::vector<size_t> of_fan(fans.fan_count), of_patch(patches.corners.size());
  const std::vector<Speaker> speakers = FindSpeakers(patches, fans);
  for (int32_t fan = 0; fan < fans.fan_count; ++fan) {
    const auto& [patch, corner] = speakers[fan];
    if (patch == kNoPatch) continue;
    of_fan[fan] = points.size();
    const Vec3 at = patches.corners[patch][corner];
    points.Add(at + (PatchCentroid(patches, patch) - at) * kInset, normals[patch][corner]);
  }
  std::vector<std::array<Rgb, 3>> light(patches.corners.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (FillFromOpenCorners(fans.survey[i], light[i])) continue;
    of_patch[i] = points.size();
    points.Add(PatchCentroid(patches, i), PatchNormal(patches, i));
  }
  const absl::StatusOr<Gathered> gathered = gather(points);
  if (!gathered.ok()) return gathered.status();
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const bool is_open = fans.survey[i].corners[corner] == CornerState::kOpen;
      light[i][corner] =
          gathered->irradiance_lx[is_open ? of_fan[fans.fan[i][corner]] : of_patch[i]];
    }
    FillFromOpenCorners(fans.survey[i], light[i]);
  }
  return light;
}

}  // namespace lambert

// What stands on a surface: the questions that smoothing asks of the geometry.
#pragma once

#include <array>
#include <cstdint>

#include "radiosity/patch/patch_set.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Largest angle between the normals of patches that are smoothed as one surface [degrees]. A prism
// of 18 sides and more reads as a cylinder; the edges of furniture and rooms stay sharp.
inline constexpr double kSmoothAngle = 20;

// How a corner of a patch stands to the rest of it.
enum class CornerState : uint8_t {
  kOpen = 0,    // the patch speaks for it
  kCutOff = 1,  // an obstacle, such as a partition, parts it from the centre of the patch
  kHidden = 2,  // within a solid that stands on the patch, where nobody looks
};

struct PatchSurvey {
  std::array<CornerState, 3> corners{};
  double exposed_share = 1;  // of the patch's area that no solid stands on
};

// Looks along the surface with rays a little above it. `patches` and `scene` must outlive it.
// Requires: `scene` was made of `patches`.
class Surveyor {
 public:
  Surveyor(const PatchSet& patches, const RayScene& scene);

  // True where two patches turn by less than kSmoothAngle.
  bool NearlyCoplanar(PatchIndex a, PatchIndex b) const;

  // True where patches a and b, which share the side from `corner_a` of a to `other_a`, see each
  // other at its end `corner_a`, which is `corner_b` of b. Requires: NearlyCoplanar(a, b).
  bool JoinedAt(PatchIndex a, int corner_a, int other_a, PatchIndex b, int corner_b) const;

  PatchSurvey Survey(PatchIndex i) const;

 private:
  PatchSurvey SurveyClosely(PatchIndex i, std::array<bool, 3> seen) const;
  double Lift(PatchIndex i, int corner) const;
  Vec3 NearCorner(PatchIndex i, int corner) const;
  bool WithinSolid(PatchIndex i, Vec3 point) const;
  bool LeavesSolid(Vec3 point, Vec3 way) const;
  double ExposedShare(PatchIndex i, double lift) const;
  bool Free(Vec3 from, Vec3 to, PatchIndex a, PatchIndex b) const;
  bool FreeAlong(Vec3 from, Vec3 to, PatchIndex a, PatchIndex b) const;

  const PatchSet& patches_;
  const RayScene& scene_;
  const double least_cosine_;
};

}  // namespace lambert

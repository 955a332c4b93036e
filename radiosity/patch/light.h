// What a light sends to a point: for whoever asks lights explicitly instead of shooting from them.
#pragma once

#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// One sample of what a light sends to a point. The mean over uniform u, v of
//   illuminance_lx * max(0, dot(direction, normal)), where nothing stands in between,
// is the illuminance of a surface there, without bias.
struct LightSample {
  Vec3 direction;         // unit: from the point to the light
  double distance_m = 0;  // to the light; infinity for one without a place
  Rgb illuminance_lx;     // of a surface that faces the direction; {}: none, whatever is in between
};

// How many lights the scene has beside its patches.
int LightCount(const PatchSet& patches);
// Whether all samples of a light at one point are the same: one is enough.
bool IsDelta(const PatchSet& patches, int light);
// Requires: 0 <= light < LightCount(patches); `point` relative to patches.origin; u, v in [0, 1).
LightSample SampleLight(const PatchSet& patches, int light, const Vec3& point, double u, double v);

}  // namespace lambert

// What lights send: to the whole scene, and to a point, for whoever asks them explicitly instead of
// shooting from them.
#pragma once

#include <vector>

#include "radiosity/core/bounds.h"
#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// How many lights the scene has beside its patches.
int LightCount(const PatchSet& patches);

// The flux that each light sends per channel [lm]. Of a distant light: what enters the box around
// the patches; of a sky: what enters the sphere around that box. Requires: a patch.
std::vector<Rgb> LightFlux(const PatchSet& patches);

// Area of a box as parallel light sees it [m2].
double ProjectedArea(const Bounds& box, const Vec3& direction);
// Area of the disk that the sphere around a box is from anywhere outside [m2].
double DiskArea(const Bounds& box);

// One sample of what a light sends to a point. The mean over uniform u, v of
//   illuminance_lx * max(0, dot(direction, normal)), where nothing stands in between,
// is the illuminance of a surface there, without bias.
struct LightSample {
  Vec3 direction;         // unit: from the point to the light
  double distance_m = 0;  // to the light; infinity for one without a place
  Rgb illuminance_lx;     // of a surface that faces the direction; {}: none, whatever is in between
};

// Whether all samples of a light at one point are the same: one is enough.
bool IsDelta(const PatchSet& patches, int light);
// Requires: 0 <= light < LightCount(patches); `point` relative to patches.origin; u, v in [0, 1).
LightSample SampleLight(const PatchSet& patches, int light, const Vec3& point, double u, double v);

}  // namespace lambert

// The solution as a camera sees it, pixel by pixel.
#pragma once

#include <vector>

#include "radiosity/output/exposure.h"
#include "radiosity/output/smooth.h"
#include "radiosity/output/view.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solution.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Rows from top to bottom; every vector has width * height entries, 0 where nothing is seen.
struct Picture {
  int width = 0, height = 0;             // pixels
  Exposure exposure;
  std::vector<Rgb> radiosity_lm_per_m2;  // means over the pixel
  std::vector<Rgb> irradiance_lx;
  std::vector<Rgb> std_error_lm_per_m2;
  std::vector<Rgb> display;              // developed, 0..1, background included
  std::vector<PatchIndex> patch;         // at the middle of the pixel, or kNoPatch
};

// Light at corners: irradiance is smoothed (smooth.h); reflectance and exitance stay the patch's.
struct CornerLight {
  CornerFans fans;
  std::vector<Rgb> irradiance_lx;        // by fan

  Rgb Irradiance(PatchIndex patch, int corner) const {
    return irradiance_lx[fans.fan[patch][corner]];
  }
};
CornerLight MakeCornerLight(const PatchSet& patches, const RayScene& scene,
                            const std::vector<Rgb>& irradiance_lx);

// Draws a picture whose longer side has `longer_side` pixels: one ray a pixel, 16 where neighbours
// differ. The exposure is chosen from the picture itself.
Picture DrawPicture(const View& view, const PatchSet& patches, const RayScene& scene,
                    const Solution& solution, const CornerLight& light, int longer_side = 960);

}  // namespace lambert

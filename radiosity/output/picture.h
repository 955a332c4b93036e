// The solution as a camera sees it, pixel by pixel.
#pragma once

#include <array>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/gather/gather_points.h"
#include "radiosity/output/exposure.h"
#include "radiosity/output/surface_reader.h"
#include "radiosity/output/view.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solution.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Rows from top to bottom; every vector has width * height entries, 0 where nothing is seen.
struct Picture {
  int width = 0, height = 0;  // pixels
  Exposure exposure;
  std::vector<Rgb> radiosity_lm_per_m2;  // mean over the pixel
  std::vector<Rgb> display;              // the same developed, 0..1, background included
  // At the middle of the pixel, so that all three are of one patch:
  std::vector<PatchIndex> patch;  // kNoPatch: nothing
  std::vector<Rgb> irradiance_lx;
  std::vector<Rgb> std_error_lm_per_m2;
};

inline constexpr int kPictureSide = 960;  // pixels

// Draws a picture whose longer side has `longer_side` pixels: one ray a pixel, 16 where neighbours
// differ. Irradiance is interpolated between corners (`corner_irradiance_lx`, from
// SmoothIrradiance); what is reflected and emitted is what `surfaces` says of the very point, and
// what it says is cut away is seen through.
Picture DrawPicture(const View& view, const PatchSet& patches, const RayScene& scene,
                    const Solution& solution, const SurfaceReader& surfaces,
                    const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
                    int longer_side = kPictureSide, const PictureOptions& options = {});

// The same where the irradiance of each pixel is gathered at what its middle sees, with the normal
// interpolated between corners (SmoothNormals). The other rays of a pixel take that of the nearest
// middle around them on the same surface; corner irradiance is for those that have none. Fails as
// `gather` does.
absl::StatusOr<Picture> DrawGatheredPicture(
    const View& view, const PatchSet& patches, const RayScene& scene, const Solution& solution,
    const SurfaceReader& surfaces, const std::vector<std::array<Rgb, 3>>& corner_irradiance_lx,
    const std::vector<std::array<Vec3, 3>>& corner_normals, const GatherFunction& gather,
    int longer_side = kPictureSide, const PictureOptions& options = {});

// Corner irradiance for DrawPicture that shows every patch flat, as it was solved.
std::vector<std::array<Rgb, 3>> FlatIrradiance(const std::vector<Rgb>& irradiance_lx);

}  // namespace lambert

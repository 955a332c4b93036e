// How far patches of one value each are from the light that varies inside them.
#pragma once

#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solution.h"

namespace lambert {

struct MeshError {
  // Of patch i: A_i rho_i^2 v_i [lm^2/m^2] with v_i the estimated variance of the irradiance within
  // it; 0 where neighbours differ by no more than their noise.
  std::vector<double> squares;
  // CONTRACT's rms_area against light that varies freely: root of their sum over the area, relative
  // to the mean reflected radiosity; 0 where nothing is reflected.
  double rms_area = 0;
};

// Of all differences that are taken for more than noise, about this share is noise, at most.
inline constexpr double kFalseShare = 0.05;

// From the differences between patches of one plane that share an edge. In a mesh of equilateral
// triangles with edge h a linear irradiance of gradient g has the variance g^2 h^2 / 24 in a patch,
// and its centre is h / sqrt(3) from each of three neighbours: v = sum over them of difference^2 /
// 12. A step inside a patch has more, up to a quarter of its square: the estimate takes three times
// the former. Of z = difference / noise those k of m pairs count, less their noise, which
// exp(-z^2 / 2) <= kFalseShare k / m holds for (BH95; the left side bounds the chance of such a z):
// where light does not vary there is seldom one. The noise of a patch is that of the rays that it
// was hit by, or the solution's standard error where that is larger. Requires: a solution of shot
// rays.
MeshError EstimateMeshError(const PatchSet& patches, const Solution& solution);

}  // namespace lambert

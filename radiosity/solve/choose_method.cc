#include "radiosity/solve/choose_method.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "radiosity/patch/convex.h"
#include "radiosity/patch/surface_tree.h"
#include "radiosity/solve/needs.h"

namespace lambert {
namespace {

// Measured (docs/benchmarks.md, "Which method auto takes").
constexpr double kExactSecondsPerPair = 0.8e-6;  // form factors and who hides whom
constexpr double kExactRaysPerPair = 0.05;       // from here on it has the least error^2 x time
constexpr double kVarianceOfPatch = 0.6;         // relative area-weighted, of pmcr, times its rays
constexpr double kRaysPerSecond = 5e6;           // of one thread
constexpr double kPatience_s = 6;                // of preparing, where nothing is said of time
constexpr double kSparseRays = 100;              // a patch: fewer make noise worth spreading
constexpr double kFlatShare = 0.5;               // of the area
constexpr PatchIndex kPatchesOfFlatPart = 4;

// Rays that the stop rules leave to a shooting method.
double ExpectedRays(double patches, const SolveOptions& options) {
  double rays = std::numeric_limits<double>::infinity();
  if (options.max_rays > 0) rays = static_cast<double>(options.max_rays);
  if (options.max_time_s > 0) rays = std::min(rays, options.max_time_s * kRaysPerSecond);
  const bool no_budget = options.max_rays == 0 && options.max_time_s == 0;
  const double error = options.max_error == 0 && no_budget ? kDefaultMaxError : options.max_error;
  if (error > 0) rays = std::min(rays, kVarianceOfPatch * patches / (error * error));
  return rays;
}

// What such a warning is about, exact takes otherwise than rays do (docs/exact.md).
bool IsAmbiguous(const PatchSet& patches) {
  return std::any_of(patches.warnings.begin(), patches.warnings.end(), [](const Warning& warning) {
    return warning.reason == "COPLANAR_OVERLAP" || warning.reason == "LIGHT_ON_SURFACE";
  });
}

// Share of the area whose patches can share light with others.
double FlatShare(const PatchSet& patches) {
  const SurfaceTree tree(patches);
  double area = 0, flat = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    area += patches.area_m2[i];
    const int32_t surface = tree.SurfaceOf(i);
    if (surface < 0) continue;
    const Element& element = tree.elements()[surface];
    if (element.end - element.begin >= kPatchesOfFlatPart) flat += patches.area_m2[i];
  }
  return flat / area;
}

template <typename... Values>
std::string Text(const char* format, Values... values) {
  char text[240];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

}  // namespace

MethodChoice ChooseMethod(const PatchSet& patches, const SolveOptions& options, bool adapted) {
  if (adapted && !IsStiff(patches)) {
    return {Method::kWalk,
            "patches are split where light varies: so that none spreads what it sends, light goes "
            "on from where it arrives"};
  }
  const double n = patches.size(), rays = ExpectedRays(n, options);
  if (patches.size() <= kMaxExactPatches && !IsAmbiguous(patches) && !HasSky(patches)) {
    const double seconds = kExactSecondsPerPair * n * n;
    const bool in_time = options.max_time_s == 0 || seconds <= options.max_time_s / 2;
    if (in_time && IsConvex(patches)) {
      return {Method::kExact, "the scene is convex: form factors are closed forms, without noise"};
    }
    if (in_time && seconds <= kPatience_s && rays >= kExactRaysPerPair * n * n) {
      return {Method::kExact,
              Text("few patches: form factors in closed form, about %.2g s, leave less noise than "
                   "%.2g rays",
                   seconds, rays)};
    }
  }
  const bool may_share = !options.shoot.parts.without.Has(Part::kHierarchy);
  if (may_share && rays <= kSparseRays * n) {
    const double share = FlatShare(patches);
    if (share >= kFlatShare) {
      return {Method::kPhsHier,
              Text("about %.2g rays for each patch, and %.0f %% of the area is flat and finely "
                   "divided: neighbours share their light",
                   rays / n, 100 * share)};
    }
  }
  return {Method::kPmcr,
          Text("about %.2g rays for each patch, so that densities would not pay", rays / n)};
}

}  // namespace lambert

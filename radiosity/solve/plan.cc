#include "radiosity/solve/plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "radiosity/shoot/directions.h"

namespace lambert {
namespace {

constexpr int64_t kMinFirstPassRays = 1 << 13;
constexpr int64_t kMaxFirstPassRays = 1 << 20;
constexpr int64_t kAmbientRaysOfPatch = 64;
constexpr int64_t kMaxExactPassRays = 1 << 25;
// A pass takes some thirty exchanges with the workers, however small: no more than ten or so of
// them.
constexpr int64_t kLeastShareOfBudget = 100;
constexpr int64_t kPassesInBudget = 4;  // the first pass takes at most this share of --max-rays
// Mean area times mean inverse area, 1 for equal patches. Over it, small patches stand among large
// ones and pyramids send them more rays; under it they only add noise (docs/methods.md).
constexpr double kUnevenAreas = 4;
// From here on a pass has over a thousand steps.
constexpr double kStiffReflectance = 0.99, kStiffShare = 0.01;

double AreaUnevenness(const PatchSet& patches) {
  double sum = 0, inverse = 0;
  for (double area : patches.area_m2) {
    sum += area;
    inverse += 1 / area;
  }
  const double n = patches.size();
  return (sum / n) * (inverse / n);
}

std::string Text(double value, const char* format = "%.3g") {
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

int64_t CountBlack(const PatchSet& patches) {
  return std::count_if(patches.reflectance.begin(), patches.reflectance.end(),
                       [](const Rgb& rho) { return Mean(rho) == 0; });
}

// Bytes a patch of what directions take, beside the tracer and what every method has.
int64_t DirectionBytes(const ShootOptions& shoot) {
  if (!UsesPyramids(shoot.method)) return 0;
  constexpr int64_t kKept = 8, kCorners = 72, kClusters = 46, kPatches = 125;
  // Geometry 36, tree 52, where flux rests 2 * 32.
  if (shoot.method == Method::kPhsHier) return kKept + kPatches + 152;
  if (ReadsPatches(shoot)) return kKept + kPatches + 184;  // targets
  const bool probes = shoot.method == Method::kHs97 || shoot.method == Method::kHs98;
  return kKept + (probes ? 0 : kCorners + kClusters);
}

// Peaks as bench/worker_memory.sh measures them (docs/benchmarks.md).
int64_t WorkerBytes(const PatchSet& patches, const ShootOptions& shoot) {
  const int64_t n = patches.size();
  // Tracer 90 and its twin for rays that meet backs 66, with 33 while it is built; frames 64, what
  // arrives 32, units and results 35.
  const int64_t of_patch = 320 + DirectionBytes(shoot);
  // Two halves of a matrix of doubles, and a link and its weight for up to half of all pairs.
  const int64_t of_pair = shoot.method == Method::kExact ? 2 * 4 + 12 : 0;
  return n * of_patch + n * n * of_pair;
}

PlanItem PyramidItem(const ShootOptions& shoot, double unevenness, bool chosen) {
  PlanItem item{"pyramids", !UsesPyramids(shoot.method), "", ""};
  if (!chosen) {
    item.reason = std::string("the method is ") + MethodName(shoot.method) + ", as asked";
  } else if (item.left_out) {
    item.reason = "patch areas are even (mean area times mean inverse area " + Text(unevenness) +
                  ", under " + Text(kUnevenAreas) + "): densities would only add noise";
  } else {
    item.reason = "patch areas are uneven (mean area times mean inverse area " + Text(unevenness) +
                  "): small patches get more rays";
  }
  return item;
}

PlanItem DensityItem(const PatchSet& patches, const ShootOptions& shoot) {
  const int64_t least = MinRaysForDensities(patches, shoot);
  return {"densities of dim patches", true,
          "a patch that shoots under " + std::to_string(least) +
              " rays in a visit shoots them by the cosine law",
          "keeps the densities under a tenth of the time of tracing"};
}

PlanItem ClearPairsItem() {
  return {"rays between patches in plain sight", true,
          "where nothing reaches into the hull of two patches their form factor is a closed form",
          "every ray of a convex scene"};
}

PlanItem AmbientItem(bool used) {
  if (used) {
    return {"ambient flux", false,
            "some part reflects " + Text(100 * kStiffReflectance) +
                " % or more: where little is lost at a bounce, flux is shot before it has arrived",
            ""};
  }
  return {"ambient flux", true,
          "less than " + Text(100 * kStiffShare) + " % of the area reflects " +
              Text(100 * kStiffReflectance) + " % or more: light dies out soon",
          "the search for parts that exchange no light"};
}

// Whether some part of the scene, such as one room of it, may reflect nearly all.
bool IsStiff(const PatchSet& patches) {
  double area = 0, bright = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Rgb rho = patches.reflectance[i];
    area += patches.area_m2[i];
    if (std::max({rho.r, rho.g, rho.b}) >= kStiffReflectance) bright += patches.area_m2[i];
  }
  return bright >= kStiffShare * area;
}

// Large enough that sampling takes about as long as the linear system.
int64_t FirstPassRays(const PatchSet& patches, Method method, bool ambient) {
  const int64_t n = patches.size();
  // Where flux is shot ahead the noise is shot again: as little as there is with many rays a patch.
  if (ambient) return std::clamp(kAmbientRaysOfPatch * n, kMinFirstPassRays, kMaxExactPassRays);
  return std::clamp<int64_t>(method == Method::kExact ? n * n : 2 * n, kMinFirstPassRays,
                             method == Method::kExact ? kMaxExactPassRays : kMaxFirstPassRays);
}

}  // namespace

Plan MakePlan(const PatchSet& patches, const SolveOptions& options) {
  Plan plan;
  plan.options = options;
  SolveOptions& solve = plan.options;
  const bool chosen = solve.shoot.method == Method::kAuto;
  const double unevenness = AreaUnevenness(patches);
  if (chosen) solve.shoot.method = unevenness > kUnevenAreas ? Method::kPhs : Method::kPmcr;
  if (solve.max_error == 0 && solve.max_rays == 0 && solve.max_time_s == 0) {
    solve.max_error = kDefaultMaxError;
  }
  solve.ambient = IsStiff(patches) && solve.shoot.method != Method::kExact;
  plan.patches = patches.size();
  plan.worker_bytes = WorkerBytes(patches, solve.shoot);
  plan.first_pass_rays = FirstPassRays(patches, solve.shoot.method, solve.ambient);
  if (solve.max_rays > 0) {
    const int64_t share = solve.max_rays / kPassesInBudget;
    // mcr shares its budget out evenly.
    const bool even = solve.shoot.method == Method::kMcr;
    plan.first_pass_rays =
        std::max<int64_t>(1, even ? share : std::min(plan.first_pass_rays, share));
  }
  plan.items.push_back(PyramidItem(solve.shoot, unevenness, chosen));
  if (UsesPyramids(solve.shoot.method)) {
    plan.items.push_back(DensityItem(patches, solve.shoot));
  }
  if (solve.shoot.method == Method::kExact) plan.items.push_back(ClearPairsItem());
  plan.items.push_back(AmbientItem(solve.ambient));
  if (const int64_t black = CountBlack(patches); black > 0) {
    plan.items.push_back(
        {"rays from black patches", true, std::to_string(black) + " patches reflect nothing",
         Text(100.0 * static_cast<double>(black) / static_cast<double>(patches.size()), "%.0f") +
             " % of the patches never shoot what they receive"});
  }
  return plan;
}

}  // namespace lambert

#include "radiosity/solve/needs.h"

#include <algorithm>
#include <cstdio>

#include "radiosity/patch/convex.h"
#include "radiosity/patch/surface_tree.h"
#include "radiosity/patch/unlit_rooms.h"
#include "radiosity/shoot/directions.h"
#include "radiosity/shoot/light_groups.h"

namespace lambert {
namespace {

// What was measured, in CPU time (docs/benchmarks.md, "What the plan leaves out").
constexpr double kSearchRaySeconds = 0.11e-6;  // a ray that looks for groups of patches

// From here on a pass has over a thousand steps.
constexpr double kStiffReflectance = 0.99, kStiffShare = 0.01;
// Clusters count sooner from about here on (docs/benchmarks.md, "What densities cost").
constexpr PatchIndex kLeastClustered = 1000;

std::string Text(double value, const char* format = "%.3g") {
  char text[64];
  std::snprintf(text, sizeof(text), format, value);
  return text;
}

int64_t CountBlack(const PatchSet& patches) {
  return std::count_if(patches.reflectance.begin(), patches.reflectance.end(),
                       [](const Rgb& rho) { return Mean(rho) == 0; });
}

bool IsGray(const Rgb& value) { return value.r == value.g && value.g == value.b; }

Need ColorNeed(const PatchSet& patches) {
  int64_t colored = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    if (!IsGray(patches.reflectance[i]) || !IsGray(patches.exitance_lm_per_m2[i])) ++colored;
  }
  const auto lights =
      std::count_if(patches.lights.begin(), patches.lights.end(), [](const Light& light) {
        const bool is_colored = HasTable(light) && light.table->grid().channels > 1;
        return is_colored || !IsGray(light.strength);
      });
  if (colored + lights == 0) {
    // Deposits are 16 bytes for 32, visits 32 for 48.
    return {Part::kColor, "three channels", false, "all reflectances and all lights are gray",
            "half of the bytes of a result, a third of those of a unit, and " +
                Text(16e-6 * patches.size()) + " MB in each thread of a worker"};
  }
  const std::string reason =
      std::to_string(colored) + " patches and " + std::to_string(lights) + " lights are not gray";
  return {Part::kColor, "three channels", true, reason, "", reason};
}

Need PyramidNeed(Method method) {
  Need need{Part::kPyramids, "pyramids", UsesPyramids(method)};
  need.reason = std::string("the method is ") + MethodName(method) + ", as asked";
  if (!need.needed) {
    need.only_way = std::string("the method ") + MethodName(method) + " has none; use --method phs";
    if (method != Method::kExact) need.saving = "about 1e-8 s of CPU time a ray";
  } else if (method == Method::kImportance) {
    need.only_way = "the method importance is its pyramids; use --method pmcr";
  }
  return need;
}

Need DimDensityNeed(const PatchSet& patches, const ShootOptions& shoot) {
  return {Part::kDimDensities, "densities of dim patches", false,
          "a patch that shoots under " + std::to_string(MinRaysForDensities(patches, shoot)) +
              " rays in a visit shoots them by the cosine law",
          "densities stay under a tenth of the time of tracing; with all of them a room of 1,450 "
          "patches takes 1.45 times the CPU time"};
}

Need BlackNeed(const PatchSet& patches, bool counts) {
  const int64_t black = CountBlack(patches);
  Need need{Part::kBlack, "black patches", false,
            std::to_string(black) + " patches reflect nothing: they shoot nothing" +
                (counts ? " and do not count in densities" : "")};
  need.saving = Text(100.0 * static_cast<double>(black) / patches.size(), "%.0f") +
                " % of the patches never shoot what they receive";
  if (!counts)
    need.only_way = "what reflects nothing has nothing to shoot, and no patch is counted";
  return need;
}

Need UnlitNeed(const PatchSet& patches, int64_t unlit) {
  return {
      Part::kUnlit, "unlit rooms", false,
      std::to_string(unlit) +
          " patches are walls of closed rooms that no light reaches: nothing is shot there, and "
          "they do not count in densities",
      Text(100.0 * static_cast<double>(unlit) / patches.size(), "%.0f") +
          " % of the patches are never aimed at"};
}

Need ClusterNeed(const PatchSet& patches) {
  const bool many = patches.size() >= kLeastClustered;
  return {Part::kClusters, "counting by clusters", many,
          std::string(many ? "from " : "under ") + std::to_string(kLeastClustered) +
              " patches on, balls around clusters spare most vertices",
          "1 % of the CPU time"};
}

Need AlphaNeed(const PatchSet& patches) {
  const bool convex = IsConvex(patches);
  return {Part::kAlpha, "counts of what was hit", !convex,
          convex ? "the scene is convex: what stands in a pyramid is hit"
                 : "some patches may hide others",
          "densities anew for every visit: up to half of the CPU time"};
}

Need HierarchyNeed(const PatchSet& patches) {
  const bool has_elements = !SurfaceTree(patches).elements().empty();
  return {Part::kHierarchy, "hierarchy of elements", has_elements,
          has_elements ? "light that is weak rests at elements of several patches"
                       : "no flat surface has two patches: every element is a patch"};
}

Need AmbientNeed(const PatchSet& patches) {
  const double seconds = kSearchRaySeconds * static_cast<double>(LightGroupRays(patches.size()));
  if (IsStiff(patches)) {
    return {Part::kAmbient, "ambient flux", true,
            "some part reflects " + Text(100 * kStiffReflectance) +
                " % or more: where little is lost at a bounce, flux is shot before it has arrived"};
  }
  return {Part::kAmbient, "ambient flux", false,
          "less than " + Text(100 * kStiffShare) + " % of the area reflects " +
              Text(100 * kStiffReflectance) + " % or more: light dies out soon",
          "the search for parts that exchange no light: about " + Text(seconds, "%.2g") + " s"};
}

Need VisibilityNeed(const PatchSet& patches, Method method) {
  Need need{Part::kVisibility, "what hides what", true};
  if (method != Method::kExact) {
    need.reason = "rays end at the first patch that they meet";
    need.only_way = "only the method exact can do without rays, in a convex scene";
  } else if (!IsConvex(patches)) {
    need.reason =
        "some patches may stand between others: rays go between those pairs only; where nothing "
        "reaches into the hull of two patches their form factor is a closed form";
    need.only_way = "some patches may stand between others";
  } else {
    need.needed = false;
    need.reason = "the scene is convex: every form factor is a closed form";
    need.saving = "all rays: up to 4 million that look for a way out, about .6 s";
  }
  return need;
}

Need StdErrorNeed(const SolveOptions& options) {
  Need need{
      Part::kStdError, "replicates", true,
      "passes are independent, and their spread is the standard error",
      "passes, each of some thirty exchanges with the workers: 14 % of the CPU time of 1e6 rays"};
  if (options.max_rays == 0 || options.max_error > 0) {
    need.only_way = "a wanted error or a budget of time is judged by it; ask for --max-rays alone";
  }
  return need;
}

}  // namespace

bool IsStiff(const PatchSet& patches) {
  double area = 0, bright = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Rgb rho = patches.reflectance[i];
    area += patches.area_m2[i];
    if (std::max({rho.r, rho.g, rho.b}) >= kStiffReflectance) bright += patches.area_m2[i];
  }
  return bright >= kStiffShare * area;
}

std::vector<Need> FindNeeds(const PatchSet& patches, const SolveOptions& options) {
  const ShootOptions& shoot = options.shoot;
  const bool counts = CountsPatches(shoot);
  std::vector<Need> needs = {ColorNeed(patches), PyramidNeed(shoot.method)};
  if (UsesPyramids(shoot.method)) needs.push_back(DimDensityNeed(patches, shoot));
  if (counts) needs.push_back(ClusterNeed(patches));
  if (shoot.method == Method::kPhsAlpha) needs.push_back(AlphaNeed(patches));
  if (shoot.method == Method::kPhsHier) needs.push_back(HierarchyNeed(patches));
  const bool by_steps = shoot.method != Method::kExact && shoot.method != Method::kWalk;
  if (by_steps) needs.push_back(AmbientNeed(patches));
  needs.push_back(VisibilityNeed(patches, shoot.method));
  needs.push_back(StdErrorNeed(options));
  if (CountBlack(patches) > 0) needs.push_back(BlackNeed(patches, counts));
  if (counts) {
    const std::vector<bool> unlit = FindUnlitWalls(patches);
    const auto count = std::count(unlit.begin(), unlit.end(), true);
    if (count > 0) needs.push_back(UnlitNeed(patches, count));
  }
  return needs;
}

}  // namespace lambert

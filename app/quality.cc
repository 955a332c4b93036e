#include "app/option_checks.h"
#include "app/option_groups.h"
#include "radiosity/solve/adapt_mesh.h"

namespace lambert::app {
namespace {

constexpr char kScene[] = "Scene";
constexpr int64_t kFinalPatches = 200'000;  // of adaptive meshing
constexpr int kFinalRays = 64;              // of a final gather

// PatchOptions::adapt_patches.
int64_t AdaptPatches(const Draft& draft, bool may_split) {
  const bool is_final = draft.quality == "final";
  // What is compared to a reference is of the reference's patches.
  const bool suits = may_split && draft.options.reference_path.empty();
  const bool on = suits && (draft.quality == "draft" || is_final);
  if (draft.adapt == "off" || (draft.adapt.empty() && !on)) return 0;
  if (draft.adapt_patches > 0) return draft.adapt_patches;
  return is_final ? kFinalPatches : kDefaultAdaptPatches;
}

}  // namespace

void AddAdaptOptions(CLI::App& command, Draft& draft) {
  command
      .add_option("--adapt", draft.adapt,
                  "split patches where light varies inside them: on or off (default: on with\n"
                  "--quality draft or final, but not with --max-edge 0 or --reference)")
      ->option_text("on|off")
      ->check(OneOf({"on", "off"}))
      ->group(kScene);
  command
      .add_option("--adapt-patches", draft.adapt_patches,
                  "of --adapt, at most (50k; with --quality final 200k)")
      ->option_text("N")
      ->transform(CountFrom(1, kAnyCount))
      ->group(kScene);
}

void SettleQuality(Draft& draft, bool counts_for_error, bool may_split) {
  const std::string& quality = draft.quality;
  if (!quality.empty() && counts_for_error) {
    draft.options.solve.max_error = quality == "preview" ? 0.1 : quality == "draft" ? 0.03 : 0.01;
  }
  const int rays = quality == "final" ? kFinalRays : 0;
  draft.options.final_gather_rays = draft.final_gather_rays < 0 ? rays : draft.final_gather_rays;
  draft.options.patch.adapt_patches = AdaptPatches(draft, may_split);
}

}  // namespace lambert::app

#include "radiosity/solve/plan.h"

#include <algorithm>

#include "radiosity/core/error.h"
#include "radiosity/shoot/directions.h"
#include "radiosity/shoot/importance.h"
#include "radiosity/solve/choose_method.h"
#include "radiosity/solve/needs.h"

namespace lambert {
namespace {

constexpr int64_t kMinFirstPassRays = 1 << 13;
constexpr int64_t kMaxFirstPassRays = 1 << 20;
constexpr int64_t kAmbientRaysOfPatch = 64;
constexpr int64_t kMaxExactPassRays = 1 << 25;
constexpr int64_t kPassesInBudget = 4;  // the first pass takes at most this share of --max-rays
constexpr int64_t kPilotShare = 32;     // and this one where no standard error is wanted

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

// The method before its parts are decided.
MethodChoice ResolveMethod(const PatchSet& patches, const SolveOptions& options, bool adapted) {
  const ShootOptions& shoot = options.shoot;
  if (shoot.method != Method::kAuto) return {shoot.method, ""};
  if (shoot.parts.with.Has(Part::kPyramids)) return {Method::kPhs, "pyramids are asked for"};
  if (shoot.parts.without.Has(Part::kPyramids)) return {Method::kPmcr, "no pyramids are asked for"};
  return ChooseMethod(patches, options, adapted);
}

// The method without the parts that are left out of it.
Method WithoutParts(Method method, PartSet without) {
  if (method == Method::kPhsAlpha && without.Has(Part::kAlpha)) method = Method::kPhs;
  if (method == Method::kPhsHier && without.Has(Part::kHierarchy)) method = Method::kPhs;
  const bool is_pyramids = UsesPyramids(method) && method != Method::kPhsHier;
  return is_pyramids && without.Has(Part::kPyramids) ? Method::kPmcr : method;
}

PlanItem Decide(const Need& need, const Parts& asked, Parts& decided) {
  const bool with = asked.with.Has(need.part), without = asked.without.Has(need.part);
  const bool left_out = without || (!with && !need.needed);
  PlanItem item{PartName(need.part), need.item, left_out, with || without, need.reason, ""};
  (item.left_out ? decided.without : decided.with).Add(need.part);
  if (item.forced) item.reason = "as asked; by itself: " + item.reason;
  if (item.left_out) item.saving = need.saving;
  return item;
}

absl::Status Refused(const char* option, Part part, const std::string& why) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"FIELD_INVALID", std::string("--") + option + " " + PartName(part), why,
                    "see lambert plan"});
}

}  // namespace

absl::Status ValidateFor(const PatchSet& patches, const SolveOptions& options, bool adapted) {
  if (absl::Status status = ValidateFor(patches, options.shoot); !status.ok()) return status;
  const Parts& asked = options.shoot.parts;
  if (asked == Parts{}) return absl::OkStatus();
  SolveOptions solve = options;
  solve.shoot.method = ResolveMethod(patches, options, adapted).method;
  PartSet there;
  for (const Need& need : FindNeeds(patches, solve)) {
    there.Add(need.part);
    const bool other_way = need.needed ? asked.without.Has(need.part) : asked.with.Has(need.part);
    if (other_way && !need.only_way.empty()) {
      return Refused(need.needed ? "without" : "with", need.part, need.only_way);
    }
  }
  for (Part part : AllParts()) {
    if (asked.with.Has(part) && !there.Has(part)) {
      return Refused("with", part,
                     std::string("the method ") + MethodName(solve.shoot.method) +
                         " has no such part in this scene");
    }
  }
  return absl::OkStatus();
}

// Large enough that sampling takes about as long as the linear system.
int64_t FirstPassRays(const PatchSet& patches, const SolveOptions& planned) {
  const int64_t n = patches.size();
  const bool exact = planned.shoot.method == Method::kExact;
  int64_t rays = std::clamp<int64_t>(exact ? n * n : 2 * n, kMinFirstPassRays,
                                     exact ? kMaxExactPassRays : kMaxFirstPassRays);
  // Where flux is shot ahead the noise is shot again: as little as there is with many rays a patch.
  if (planned.shoot.parts.with.Has(Part::kAmbient)) {
    rays = std::clamp(kAmbientRaysOfPatch * n, kMinFirstPassRays, kMaxExactPassRays);
  }
  if (planned.max_rays == 0) return rays;
  // One pass that tells how many rays a pass takes, and one with all the others.
  const bool twice = planned.shoot.parts.without.Has(Part::kStdError);
  if (twice) return std::max<int64_t>(1, planned.max_rays / kPilotShare);
  const int64_t share = planned.max_rays / kPassesInBudget;
  // mcr shares its budget out evenly.
  const bool even = planned.shoot.method == Method::kMcr;
  return std::max<int64_t>(1, even ? share : std::min(rays, share));
}

Plan MakePlan(const PatchSet& patches, const SolveOptions& options, bool adapted) {
  Plan plan;
  plan.options = options;
  SolveOptions& solve = plan.options;
  const MethodChoice choice = ResolveMethod(patches, options, adapted);
  solve.shoot.method = choice.method;
  if (solve.max_error == 0 && solve.max_rays == 0 && solve.max_time_s == 0) {
    solve.max_error = kDefaultMaxError;
  }
  Parts decided;
  for (Need& need : FindNeeds(patches, solve)) {
    if (need.part == Part::kPyramids && !choice.reason.empty()) need.reason = choice.reason;
    plan.items.push_back(Decide(need, options.shoot.parts, decided));
  }
  solve.shoot.parts = decided;
  solve.shoot.method = WithoutParts(solve.shoot.method, decided.without);
  if (decided.with.Has(Part::kDimDensities)) solve.shoot.pyramids.min_rays = 1;
  plan.patches = patches.size();
  plan.worker_bytes = WorkerBytes(patches, solve.shoot);
  plan.first_pass_rays = FirstPassRays(patches, solve);
  return plan;
}

}  // namespace lambert

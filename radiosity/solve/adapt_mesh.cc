#include "radiosity/solve/adapt_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <utility>

#include "radiosity/core/philox.h"
#include "radiosity/solve/needs.h"

namespace lambert {
namespace {

constexpr double kShareOfError = 0.8;  // that the patches have which are split at once (Dor96)
// Of the error's square that a patch loses when it is split: three quarters where light varies
// evenly, half where it has a step.
constexpr double kLostBySplit = 2.0 / 3;
constexpr double kLeastGrowth = 1.05;  // of the patches: less is not worth a pilot
constexpr int32_t kMaxPilots = 16;
constexpr int32_t kAdaptShare = 4;  // a quarter of rays and time is for pilots
constexpr int32_t kPilotShare = kAdaptShare * kMaxPilots;
constexpr int64_t kRaysOfPatch = 256;  // of a pilot: neighbours that differ by a third are told
constexpr int64_t kLeastRays = 1 << 18, kMostRays = 1 << 23;
constexpr int64_t kCutShare = 3;             // of the budget that is left: for crossings, a third
constexpr double kRaysPerSecond = 5e6;       // of one thread (docs/benchmarks.md)
constexpr int64_t kGrowth = 3;               // of the patches, from one pilot to the next, at most
constexpr uint32_t kPilotName = 0x50494C4F;  // of their seeds' random numbers: "PILO"
constexpr double kUnsentTolerance = 0.05;    // what comes late is spread evenly

// What large triangles are split to before the first pilot, which sees no difference inside them:
// right-angled halves of squares have a sixth of the square of their longest edge, about.
double CoarseEdge(const PatchSet& patches, int64_t budget) {
  const double area = std::accumulate(patches.area_m2.begin(), patches.area_m2.end(), 0.0);
  return std::sqrt(6 * area / static_cast<double>(std::clamp<int64_t>(budget / 16, 64, 4096)));
}

int64_t PilotRays(int64_t patches, const SolveOptions& solve) {
  int64_t rays = std::clamp(kRaysOfPatch * patches, kLeastRays, kMostRays);
  if (solve.max_rays > 0) rays = std::min(rays, solve.max_rays / kPilotShare);
  if (solve.max_time_s > 0) {
    rays = std::min<int64_t>(rays, std::llround(solve.max_time_s * kRaysPerSecond / kPilotShare));
  }
  return std::max<int64_t>(1, rays);
}

// A pilot's random numbers are those of no pass of the solution.
SolveOptions PilotOptions(const PatchSet& patches, const SolveOptions& solve, int32_t number) {
  SolveOptions pilot;
  pilot.shoot.method = IsStiff(patches) ? Method::kPmcr : Method::kWalk;
  pilot.shoot.sequence = solve.shoot.sequence;
  pilot.shoot.parts.with.Add(Part::kStdError);
  const auto bits =
      Philox({static_cast<uint32_t>(number), kPilotName, 0, 0},
             {static_cast<uint32_t>(solve.seed), static_cast<uint32_t>(solve.seed >> 32)});
  pilot.seed = uint64_t{bits[1]} << 32 | bits[0];
  pilot.max_rays = PilotRays(patches.size(), solve);
  pilot.unsent_tolerance = kUnsentTolerance;
  return pilot;
}

template <typename... Values>
std::string Text(const char* format, Values... values) {
  char text[240];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

double WantedError(const SolveOptions& solve) {
  return solve.max_error > 0 ? solve.max_error : kDefaultMaxError;
}

// Why there is nothing to adapt; "" where there is.
std::string WhyNone(const PatchSet& coarse, const PatchOptions& options) {
  if (EmittedFlux(coarse) == Rgb{}) return "nothing emits light";
  if (coarse.size() >= options.adapt_patches) {
    return Text("%lld patches are the budget of %lld, or more",
                static_cast<long long>(coarse.size()),
                static_cast<long long>(options.adapt_patches));
  }
  return "";
}

// Why no pilot follows; "" where one does. `spent`: the budget of patches, 0 while some is left.
std::string WhyEnough(const Meshing& meshing, const SolveOptions& solve, int64_t spent) {
  const double wanted = WantedError(solve);
  const std::string error =
      Text("light varies inside patches by about %.2g %%", 100 * meshing.predicted_error);
  if (meshing.predicted_error <= wanted) {
    return error + Text(", under the wanted %.2g %%", 100 * wanted);
  }
  if (spent > 0) {
    return Text("the budget of %lld patches is spent; ", static_cast<long long>(spent)) + error;
  }
  if (solve.max_time_s > 0 && kAdaptShare * meshing.seconds >= solve.max_time_s) {
    return Text("a quarter of the time of %.3g s is spent; ", solve.max_time_s) + error;
  }
  if (meshing.pilots < kMaxPilots) return "";
  return Text("%d pilots are the most there are; ", kMaxPilots) + error;
}

PlanItem Item(bool left_out, const std::string& reason) {
  return {"adapt", "adaptive meshing", left_out, false, reason, ""};
}

}  // namespace

void AddMeshing(const PatchSet& coarse, const PatchOptions& options, Plan& plan) {
  if (options.adapt_patches == 0) return;
  const std::string why_none = WhyNone(coarse, options);
  if (!why_none.empty()) {
    plan.items.push_back(Item(true, why_none));
    return;
  }
  plan.items.push_back(
      Item(false, Text("pilots of %.2g rays or more look for differences between neighbours; up "
                       "to %lld patches",
                       static_cast<double>(PilotRays(coarse.size(), plan.options)),
                       static_cast<long long>(options.adapt_patches))));
}

PlanItem TellMeshing(const Meshing& meshing, int64_t patches) {
  std::string reason = meshing.reason;
  if (meshing.pilots > 0) {
    reason = Text("%d pilot(s), %.2g rays: %lld patches became %lld; ", meshing.pilots,
                  static_cast<double>(meshing.pilot_rays),
                  static_cast<long long>(meshing.coarse_patches), static_cast<long long>(patches)) +
             reason;
  }
  return Item(patches == meshing.coarse_patches, reason);
}

Splits ChooseSplits(const PatchSet& patches, const MeshError& error, int64_t most_patches) {
  std::vector<PatchIndex> order(error.squares.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](PatchIndex a, PatchIndex b) { return error.squares[a] > error.squares[b]; });
  const double all = std::accumulate(error.squares.begin(), error.squares.end(), 0.0);
  std::vector<double> sum{0};  // of the first patches
  while (sum.size() <= order.size() && sum.back() < kShareOfError * all) {
    sum.push_back(sum.back() + error.squares[order[sum.size() - 1]]);
  }
  const auto mark = [&](size_t first) -> Splits {
    return {MarkPatches(patches, {order.begin(), order.begin() + static_cast<int64_t>(first)}),
            all > 0 ? sum[first] / all : 0};
  };
  size_t count = sum.size() - 1;
  Splits splits = mark(count);
  if (CountHalved(patches, splits.marks) <= most_patches) return splits;
  size_t fits = 0;  // `count` does not
  while (count - fits > 1) {
    const size_t middle = fits + (count - fits) / 2;
    (CountHalved(patches, mark(middle).marks) <= most_patches ? fits : count) = middle;
  }
  return mark(fits);
}

absl::StatusOr<std::shared_ptr<const PatchSet>> AdaptMesh(const Scene& scene,
                                                          const PatchOptions& options,
                                                          const SolveOptions& solve, RunPilot run,
                                                          Meshing* meshing) {
  PatchOptions split = options;
  Cuts cuts;
  std::shared_ptr<const PatchSet> patches;
  const auto build = [&]() -> absl::Status {
    absl::StatusOr<PatchSet> built = BuildPatches(scene, split, cuts);
    if (built.ok()) patches = std::make_shared<const PatchSet>(*std::move(built));
    return built.status();
  };
  if (absl::Status status = build(); !status.ok()) return status;
  meshing->coarse_patches = patches->size();
  const int64_t budget = std::min(options.adapt_patches, options.max_patches);
  cuts = FindCrossings(scene, options, std::max<int64_t>(0, budget - patches->size()) / kCutShare);
  if (!cuts.crossed.empty()) {
    if (absl::Status status = build(); !status.ok()) return status;
  }
  const std::shared_ptr<const PatchSet> coarse = patches;
  meshing->reason = WhyNone(*coarse, options);
  if (!meshing->reason.empty()) return coarse;
  if (split.max_edge_m == 0) {
    split.max_edge_m = CoarseEdge(*coarse, budget);
    if (absl::Status status = build(); !status.ok()) return status;
  }
  if (patches->size() > budget) {
    split.max_edge_m = options.max_edge_m;
    patches = coarse;
  }
  const double wanted = WantedError(solve);
  while (meshing->reason.empty()) {
    const SolveOptions pilot = PilotOptions(*patches, solve, meshing->pilots);
    const absl::StatusOr<Solution> solution = run(patches, pilot, ++meshing->pilots);
    if (!solution.ok()) return solution.status();
    const MeshError error = EstimateMeshError(*patches, *solution);
    meshing->predicted_error = error.rms_area;
    if (error.rms_area == 0) {
      meshing->reason = "neighbours differ by no more than noise";
      if (cuts.levels.empty()) return coarse;
      break;
    }
    Splits splits;
    if (error.rms_area > wanted) {
      splits = ChooseSplits(*patches, error, std::min(budget, kGrowth * patches->size()));
    }
    const bool is_split = !splits.marks.empty();
    if (is_split) {
      cuts.levels.push_back(std::move(splits.marks));
      if (absl::Status status = build(); !status.ok()) return status;
      meshing->predicted_error *= std::sqrt(1 - kLostBySplit * splits.share);
    }
    const double could_be = kLeastGrowth * static_cast<double>(patches->size());
    const bool is_spent = !is_split || could_be > static_cast<double>(budget);
    meshing->reason = WhyEnough(*meshing, solve, is_spent ? budget : 0);
  }
  return patches;
}

}  // namespace lambert

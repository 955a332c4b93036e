#include <cstdio>

#include "app/commands.h"
#include "app/light_files.h"
#include "app/measure.h"
#include "app/progress_text.h"
#include "app/service.h"
#include "fmt/format.h"
#include "nlohmann/json.hpp"
#include "radiosity/output/run_json.h"
#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/plan.h"

namespace lambert::app {
namespace {

// The reference has to be of these patches, and the regions of this scene: told now, not after
// hours.
absl::Status CheckReference(const PatchSet& patches, const Options& options) {
  auto measurer = Measurer::Create(options.reference_path, options.regions);
  if (!measurer.ok()) return measurer.status();
  if (!measurer->wanted()) return FindRegions(options.regions, patches.node_names).status();
  Solution dark;
  dark.radiosity_lm_per_m2.resize(patches.size());
  dark.irradiance_lx.resize(patches.size());
  dark.std_error_lm_per_m2.resize(patches.size());
  dark.hits.resize(patches.size());
  return measurer->Measure(patches, dark).status();
}

absl::StatusOr<PatchSet> BuildHere(const SceneBundle& bundle, const Options& options) {
  auto scene = LoadGltf(bundle, options.limits);
  if (!scene.ok()) return scene.status();
  return BuildPatches(*scene, options.patch);
}

absl::StatusOr<client::PlannedScene> PlanThere(const SceneBundle& bundle, const Options& options,
                                               Interrupt& interrupt) {
  auto service = OpenService(
      options, [](const std::string& notice) { std::fprintf(stderr, "%s\n", notice.c_str()); });
  if (!service.ok()) return service.status();
  client::Client& client = *service->client;
  interrupt.OnFirst([&client] { client.Abort(); });
  auto scene = client.SubmitScene(bundle, [](int64_t, int64_t) {});
  auto plan = scene.ok() ? client.PlanScene(scene->name, options.patch, options.solve)
                         : absl::StatusOr<client::PlannedScene>(scene.status());
  interrupt.OnFirst(nullptr);
  return plan;
}

std::string StopRules(const SolveOptions& solve) {
  std::string text;
  const auto add = [&text](const std::string& rule) {
    text += (text.empty() ? "" : ", or ") + rule;
  };
  if (solve.max_error > 0) add("error " + FormatPercent(solve.max_error));
  if (solve.max_rays > 0) add(FormatCount(static_cast<double>(solve.max_rays), "rays"));
  if (solve.max_time_s > 0) add(FormatDuration(solve.max_time_s));
  return text;
}

void PrintItems(const Plan& plan, bool left_out, const char* title) {
  bool any = false;
  for (const PlanItem& item : plan.items) {
    if (item.left_out != left_out) continue;
    if (!any) std::printf("%s\n", title);
    any = true;
    std::printf("  %s (%s): %s\n", item.item.c_str(), item.part.c_str(), item.reason.c_str());
    if (!item.saving.empty()) std::printf("    saves %s\n", item.saving.c_str());
  }
}

void PrintPlan(const Plan& plan, const Options& options) {
  std::printf("patches        %lld\n", static_cast<long long>(plan.patches));
  std::printf("method         %s\n", MethodName(plan.options.shoot.method));
  std::printf("ends at        %s\n", StopRules(plan.options).c_str());
  std::printf("first pass     %s\n",
              FormatCount(static_cast<double>(plan.first_pass_rays), "rays").c_str());
  std::printf("worker memory  %s with one thread", FormatBytes(plan.worker_bytes).c_str());
  if (options.server.empty()) {
    std::printf("; here workers: %d, threads of each: %d", options.workers,
                ThreadsPerWorker(options));
  }
  std::printf("\n");
  PrintItems(plan, false, "done");
  PrintItems(plan, true, "left out");
}

nlohmann::ordered_json PlanJson(const client::PlannedScene& planned) {
  const Plan& plan = planned.plan;
  nlohmann::ordered_json warnings = nlohmann::ordered_json::array();
  for (const Warning& warning : planned.warnings) {
    warnings.push_back({{"reason", warning.reason}, {"message", warning.message}});
  }
  return {{"patches", plan.patches},
          {"method", MethodName(plan.options.shoot.method)},
          {"seed", plan.options.seed},
          {"max_error", plan.options.max_error},
          {"max_rays", plan.options.max_rays},
          {"max_time_s", plan.options.max_time_s},
          {"first_pass_rays", plan.first_pass_rays},
          {"worker_bytes", plan.worker_bytes},
          {"items", PlanItemsJson(plan)},
          {"warnings", warnings}};
}

// A server makes the plan where there is one; patches are built here only for what needs them here.
absl::StatusOr<client::PlannedScene> MakePlanned(const SceneBundle& bundle, const Options& options,
                                                 Interrupt& interrupt) {
  const bool here = options.server.empty();
  if (!here && options.reference_path.empty() && options.regions.empty()) {
    return PlanThere(bundle, options, interrupt);
  }
  auto patches = BuildHere(bundle, options);
  if (!patches.ok()) return patches.status();
  if (absl::Status status = CheckReference(*patches, options); !status.ok()) return status;
  if (!here) return PlanThere(bundle, options, interrupt);
  const bool adapted = options.patch.adapt_patches > 0;
  if (absl::Status status = ValidateFor(*patches, options.solve, adapted); !status.ok()) {
    return status;
  }
  client::PlannedScene planned{MakePlan(*patches, options.solve, adapted), patches->warnings};
  AddMeshing(*patches, options.patch, planned.plan);
  return planned;
}

}  // namespace

absl::StatusOr<ExitCode> RunPlan(const Options& options, Interrupt& interrupt) {
  auto bundle = ReadLitBundle(options.scene_path, options);
  if (!bundle.ok()) return bundle.status();
  auto planned = MakePlanned(*bundle, options, interrupt);
  if (!planned.ok()) return planned.status();
  for (const Warning& warning : planned->warnings) {
    std::fprintf(stderr, "warning: %s\n", warning.message.c_str());
  }
  if (options.json) {
    const auto replace = nlohmann::json::error_handler_t::replace;
    std::printf("%s\n", PlanJson(*planned).dump(2, ' ', false, replace).c_str());
  } else {
    PrintPlan(planned->plan, options);
  }
  return ExitCode::kDone;
}

}  // namespace lambert::app

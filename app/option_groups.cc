#include "app/option_groups.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <string>

#include "app/bench_list.h"
#include "app/light_options.h"
#include "app/option_checks.h"
#include "fmt/format.h"
#include "radiosity/core/error.h"
#include "radiosity/shoot/settings.h"

namespace lambert::app {
namespace {

constexpr char kScene[] = "Scene";
constexpr char kLimits[] = "Limits: what a scene may take at most";
constexpr char kStop[] = "When it is good enough (none given: an error of 3 %)";
constexpr char kMethod[] = "Method";
constexpr char kPyramids[] = "Pyramids of the methods phs, hs and importance";
constexpr char kPlace[] = "Where it runs";
constexpr char kMeasure[] = "Measured error";
constexpr char kBench[] = "What is compared";
constexpr char kTerminal[] = "Terminal";

// Options that bake has and bench replaces.
void RemoveOptions(CLI::App& command, const std::vector<std::string>& names) {
  for (const std::string& name : names) command.remove_option(command.get_option(name));
}

std::string MethodNames() {
  std::vector<std::string> names;
  for (Method method : AllMethods()) names.push_back(MethodName(method));
  return fmt::format("{}", fmt::join(names, ", "));
}

// What is wrong with a value of a setting; "" for nothing.
std::string CheckSetting(const ShootSetting& setting, const std::string& text) {
  ShootOptions options;
  if (!setting.set(text, options)) return fmt::format("'{}' is not {}", text, setting.value_name);
  const absl::Status status = options.Validate();
  return status.ok() ? "" : GetErrorDetail(status)->message;
}

void AddSetting(CLI::App& command, const ShootSetting& setting, ShootOptions& shoot) {
  const std::string name = setting.name, values = setting.value_name;
  CLI::Option* option = command.add_option_function<std::string>(
      "--" + name, [&setting, &shoot](const std::string& text) { setting.set(text, shoot); },
      setting.help);
  option->option_text(values)->group(name.starts_with("phs-") ? kPyramids : kMethod);
  if (values == "N") option->transform(CountFrom(0, kAnyCount));
  if (values.ends_with(",...")) option->join(',');
  option->check(Check([&setting](std::string& text) { return CheckSetting(setting, text); }));
}

// What a scene may take at most.
void AddLimitOptions(CLI::App& command, Draft& draft) {
  SceneLimits& limits = draft.options.limits;
  const auto add = [&command](const char* name, int64_t& limit, int64_t most, const char* help) {
    command.add_option(name, limit, fmt::format("{} ({})", help, limit))
        ->option_text("N")
        ->transform(CountFrom(1, most))
        ->group(kLimits);
  };
  add("--max-scene-bytes", limits.bytes, kAnyCount, "of all its files");
  add("--max-triangles", limits.triangles, kAnyCount, "with instances");
  add("--max-instances", limits.instances, kAnyCount, "of meshes");
  add("--max-image-pixels", limits.image_pixels, kAnyCount, "of one image, by its header");
  add("--max-total-pixels", limits.total_pixels, kAnyCount, "of all images that are decoded");
  add("--max-patches", draft.options.patch.max_patches, std::numeric_limits<PatchIndex>::max(),
      "after splitting");
}

// Requires: a word that --scene-unit takes.
double MetresOf(const std::string& unit) {
  if (unit == "cm") return 0.01;
  if (unit == "mm") return 0.001;
  if (unit == "in") return 0.0254;
  return unit == "ft" ? 0.3048 : 1;
}

}  // namespace

const std::vector<std::string>& OptionsOfThisProcess() {
  static const auto& names =
      *new std::vector<std::string>{"workers",       "threads",          "max-triangles",
                                    "max-instances", "max-image-pixels", "max-total-pixels"};
  return names;
}

std::vector<std::string> SettingsWithoutEffect(Method method) {
  if (method == Method::kAuto) return {};
  if (method == Method::kImportance) return {"phs-rule", "phs-metric", "allocation"};
  std::vector<std::string> names;
  if (method == Method::kExact) names = {"sequence", "allocation"};
  for (const ShootSetting& setting : ShootSettings()) {
    const bool is_of_pyramids = std::string(setting.name).starts_with("phs-");
    if (is_of_pyramids && !UsesPyramids(method)) names.push_back(setting.name);
  }
  return names;
}

void AddSceneOptions(CLI::App& command, Draft& draft) {
  PatchOptions& patch = draft.options.patch;
  command.add_option("SCENE", draft.options.scene_path, "a .glb or .gltf file")
      ->option_text("(required)")
      ->required();
  command
      .add_option("--max-edge", patch.max_edge_m,
                  "split triangles until no edge is longer, metres (absent: none is split)")
      ->option_text("M")
      ->check(NumberFrom(0))
      ->group(kScene);
  AddAdaptOptions(command, draft);
  command
      .add_flag("--two-sided", patch.two_sided,
                "both sides of every triangle reflect, whatever its material says")
      ->group(kScene);
  command
      .add_option_function<std::string>(
          "--emission-unit",
          [&patch](const std::string& unit) {
            patch.emission_unit =
                unit == "nit" ? EmissionUnit::kNit : EmissionUnit::kWattPerM2PerSr;
          },
          "of the file's emission: nit (default) or W/m2/sr, which makes every result radiometric")
      ->option_text("UNIT")
      ->check(OneOf({"nit", "W/m2/sr"}))
      ->group(kScene);
  command
      .add_option_function<std::string>(
          "--scene-unit",
          [&patch](const std::string& unit) { patch.metres_per_unit = MetresOf(unit); },
          "of the file's lengths: m (default, as glTF has it), cm, mm, in or ft")
      ->option_text("UNIT")
      ->check(OneOf({"m", "cm", "mm", "in", "ft"}))
      ->group(kScene);
  command
      .add_option_function<std::string>(
          "--blend",
          [&patch](const std::string& blend) {
            patch.blend = blend == "omit" ? Blend::kOmit : Blend::kOpaque;
          },
          "materials of alpha mode BLEND: opaque (default) or omit, which leaves them out")
      ->option_text("WHAT")
      ->check(OneOf({"opaque", "omit"}))
      ->group(kScene);
  AddLimitOptions(command, draft);
  AddLightOptions(command, draft);
}

void AddStopOptions(CLI::App& command, Draft& draft) {
  SolveOptions& solve = draft.options.solve;
  command
      .add_option("--max-error", solve.max_error,
                  "wanted error: relative area-weighted RMS, estimated (0.01 = 1 %)")
      ->option_text("F")
      ->check(NumberFrom(0))
      ->group(kStop);
  command
      .add_option("--quality", draft.quality,
                  "wanted error by name: preview (0.1), draft (0.03), final (0.01); see --adapt")
      ->option_text("NAME")
      ->check(OneOf({"preview", "draft", "final"}))
      ->group(kStop);
  command.add_option("--max-rays", solve.max_rays, "budget of rays; 1e7 and 10M are one number")
      ->option_text("N")
      ->transform(CountFrom(0, kAnyCount))
      ->group(kStop);
  command.add_option("--max-time", solve.max_time_s, "budget of time, seconds")
      ->option_text("S")
      ->check(NumberFrom(0))
      ->group(kStop);
}

void AddMethodOptions(CLI::App& command, Draft& draft) {
  ShootOptions& shoot = draft.options.solve.shoot;
  command
      .add_option_function<std::string>(
          "--method", [&shoot](const std::string& id) { shoot.method = *ParseMethod(id); },
          "auto (default: what suits the scene), " + MethodNames())
      ->option_text("ID")
      ->check(Check([](std::string& text) -> std::string {
        if (ParseMethod(text).ok()) return "";
        return fmt::format("'{}' is not one of auto, {}", text, MethodNames());
      }))
      ->group(kMethod);
  command.add_option("--seed", draft.options.solve.seed, "of the random numbers (default 1)")
      ->option_text("N")
      ->check(Check([](std::string& text) -> std::string {
        uint64_t seed = 0;
        const char* end = text.data() + text.size();
        const auto [stop, error] = std::from_chars(text.data(), end, seed);
        if (error == std::errc() && stop == end) return "";
        return fmt::format("'{}' is not a whole number from 0 to 2^64 - 1", text);
      }))
      ->group(kMethod);
  for (const ShootSetting& setting : ShootSettings()) AddSetting(command, setting, shoot);
}

void AddPlaceOptions(CLI::App& command, Draft& draft) {
  command.add_option("--workers", draft.options.workers, "workers in this process (1)")
      ->option_text("N")
      ->transform(CountFrom(1, 256))
      ->group(kPlace);
  command
      .add_option("--threads", draft.options.threads,
                  "threads of each worker (absent: the processor's, shared out)")
      ->option_text("N")
      ->transform(CountFrom(1, 1024))
      ->group(kPlace);
}

void AddServerOptions(CLI::App& command, Draft& draft) {
  command.add_option("--server", draft.options.server, "a lambert-server that does the work")
      ->option_text("HOST:PORT")
      ->group(kPlace);
  command
      .add_option("--reconnect", draft.options.reconnect_s,
                  "how long a server that is gone is tried again, seconds (60)")
      ->option_text("S")
      ->check(NumberFrom(0, 1e6))
      ->group(kPlace);
  for (const CredentialOption& credential : CredentialOptions()) {
    command
        .add_option(std::string("--") + credential.name, draft.options.credentials.*credential.file,
                    credential.help)
        ->option_text("FILE")
        ->group(kPlace);
  }
}

void AddMeasureOptions(CLI::App& command, Draft& draft) {
  command
      .add_option("--reference", draft.options.reference_path,
                  "a patches.csv to measure the error against")
      ->option_text("FILE")
      ->group(kMeasure);
  command
      .add_option("--region", draft.options.regions,
                  "a node of the local error and of the method importance, by name or index; "
                  "may be repeated")
      ->option_text("NODE")
      ->allow_extra_args(false)
      ->group(kMeasure);
}

void AddProgressOption(CLI::App& command, Draft& draft) {
  static const std::vector<std::string> names = {"auto", "bar", "plain", "json", "none"};
  command
      .add_option_function<std::string>(
          "--progress",
          [&draft](const std::string& name) {
            const auto found = std::find(names.begin(), names.end(), name);
            draft.options.progress = static_cast<ProgressMode>(found - names.begin());
          },
          "on standard error: auto (default), bar, plain, json, none")
      ->option_text("NAME")
      ->check(OneOf(names))
      ->group(kTerminal);
}

void AddWatchOption(CLI::App& command, Draft& draft) {
  command.add_flag("--watch", draft.options.watch_list, "keep the list up to date until Ctrl-C")
      ->group(kTerminal);
}

void AddJsonOption(CLI::App& command, Draft& draft) {
  command.add_flag("--json", draft.options.json, "results and errors as JSON on standard output")
      ->group(kTerminal);
}

void AddBenchOptions(CLI::App& command, Draft& draft) {
  BenchOptions& bench = draft.options.bench;
  RemoveOptions(command, {"SCENE", "--outputs", "--final-gather", "--sensors", "--work-plane",
                          "--tone-map", "--exposure", "--method", "--max-error", "--quality",
                          "--adapt", "--adapt-patches"});
  for (const char* budget : {"--max-rays", "--max-time"}) command.get_option(budget)->group(kBench);
  command.add_option("SCENE", bench.scenes, ".glb or .gltf files; several get a folder each")
      ->option_text("(required)")
      ->required();
  command
      .add_option("--methods", bench.methods,
                  "methods, by commas: all (default), pmcr, phs:depth=3:sampling=solid-angle, ...")
      ->option_text("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->group(kBench);
  command.add_option("--seeds", bench.seeds, "runs of each method and budget (4)")
      ->option_text("N")
      ->transform(CountFrom(1, 10000))
      ->group(kBench);
  command
      .add_option_function<std::vector<std::string>>(
          "--budgets",
          [&bench](const std::vector<std::string>& texts) {
            bench.budgets.clear();
            for (const std::string& text : texts) bench.budgets.push_back(*ParseBenchBudget(text));
          },
          "where errors are measured, by commas: rays (200k,2M) or seconds (1s,5s); absent: five\n"
          "steps up to --max-rays (5M) or --max-time")
      ->option_text("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(Check([](std::string& text) -> std::string {
        if (ParseBenchBudget(text).ok()) return "";
        return fmt::format("'{}' is neither rays (200k) nor seconds (1.5s)", text);
      }))
      ->group(kBench);
  command
      .add_option("--reference-rays", bench.reference_rays,
                  "rays of the reference that is made (absent: 20 times the largest budget)")
      ->option_text("N")
      ->transform(CountFrom(1, kAnyCount))
      ->group(kMeasure);
  command
      .add_option("--reference-error", bench.reference_error,
                  "residual to which it is made, estimated; without --reference-rays, however long")
      ->option_text("F")
      ->check(NumberFrom(0))
      ->group(kMeasure);
}

}  // namespace lambert::app

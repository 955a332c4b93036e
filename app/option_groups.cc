#include "app/option_groups.h"

#include <algorithm>
#include <charconv>

#include "app/bench_list.h"
#include "app/option_checks.h"
#include "fmt/format.h"

namespace lambert::app {
namespace {

constexpr char kScene[] = "Scene";
constexpr char kStop[] = "When it is good enough (none given: an error of 3 %)";
constexpr char kMethod[] = "Method";
constexpr char kPyramids[] = "Pyramids of the method phs";
constexpr char kPlace[] = "Where it runs";
constexpr char kMeasure[] = "Measured error";
constexpr char kBench[] = "What is compared";
constexpr char kTerminal[] = "Terminal";

// Options that bake has and bench replaces.
void RemoveOptions(CLI::App& command, const std::vector<std::string>& names) {
  for (const std::string& name : names) command.remove_option(command.get_option(name));
}

}  // namespace

double QualityError(const std::string& quality) {
  return quality == "preview" ? 0.1 : quality == "draft" ? 0.03 : 0.01;
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
                  "wanted error by name: preview (0.1), draft (0.03), final (0.01)")
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
  PyramidOptions& pyramids = shoot.pyramids;
  command
      .add_option_function<std::string>(
          "--method", [&shoot](const std::string& id) { shoot.method = *ParseMethod(id); },
          "auto (default: what suits the scene), pmcr (progressive Monte Carlo), phs (pyramids)")
      ->option_text("ID")
      ->check(OneOf({"auto", "pmcr", "phs"}))
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
  command
      .add_option("--phs-initial", pyramids.initial, "spherical triangles to begin with, 3..64 (4)")
      ->option_text("N")
      ->transform(CountFrom(3, 64))
      ->group(kPyramids);
  command
      .add_option("--phs-split", pyramids.split, "children of a split: 4 (edge midpoints) or 3 (4)")
      ->option_text("3|4")
      ->transform(CountFrom(3, 4))
      ->group(kPyramids);
  command.add_option("--phs-depth", pyramids.depth, "how often pyramids are split, 0..4 (2)")
      ->option_text("N")
      ->transform(CountFrom(0, 4))
      ->group(kPyramids);
  command
      .add_option("--phs-alpha1", pyramids.alpha1, "weight of the form factor in the density (1)")
      ->option_text("F")
      ->check(NumberFrom(0))
      ->group(kPyramids);
  command
      .add_option("--phs-alpha2", pyramids.alpha2, "weight of the patch count in the density (1)")
      ->option_text("F")
      ->check(NumberFrom(0))
      ->group(kPyramids);
  command
      .add_option_function<std::string>(
          "--phs-sampling",
          [&pyramids](const std::string& sampling) {
            pyramids.sampling = sampling == "projected" ? PyramidSampling::kProjectedAngle
                                                        : PyramidSampling::kSolidAngle;
          },
          "in a pyramid: projected (default, all rays alike) or solid-angle (the paper's)")
      ->option_text("NAME")
      ->check(OneOf({"projected", "solid-angle"}))
      ->group(kPyramids);
  command
      .add_option("--phs-min-rays", pyramids.min_rays,
                  "rays in one visit from which a patch gets pyramids (0: chosen by cost)")
      ->option_text("N")
      ->transform(CountFrom(0, kAnyCount))
      ->group(kPyramids);
  command
      .add_flag("--phs-count-black", pyramids.count_black, "count patches that reflect nothing too")
      ->group(kPyramids);
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
}

void AddMeasureOptions(CLI::App& command, Draft& draft) {
  command
      .add_option("--reference", draft.options.reference_path,
                  "a patches.csv to measure the error against")
      ->option_text("FILE")
      ->group(kMeasure);
  command
      .add_option("--region", draft.options.regions,
                  "a node of the local error, by name or index; may be repeated")
      ->option_text("NODE")
      ->allow_extra_args(false)
      ->group(kMeasure);
}

void AddOutputOption(CLI::App& command, Draft& draft) {
  command
      .add_option("-o,--out", draft.options.out_folder, "folder for the result; made if need be")
      ->option_text("DIR");
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

void AddJsonOption(CLI::App& command, Draft& draft) {
  command.add_flag("--json", draft.options.json, "results and errors as JSON on standard output")
      ->group(kTerminal);
}

void AddBenchOptions(CLI::App& command, Draft& draft) {
  BenchOptions& bench = draft.options.bench;
  RemoveOptions(command, {"SCENE", "--method", "--max-error", "--quality"});
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

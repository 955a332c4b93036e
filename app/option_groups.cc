#include "app/option_groups.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>

#include "fmt/format.h"
#include "radiosity/core/error.h"
#include "radiosity/shoot/settings.h"

namespace lambert::app {
namespace {

constexpr char kScene[] = "Scene";
constexpr char kStop[] = "When it is good enough (none given: an error of 3 %)";
constexpr char kMethod[] = "Method";
constexpr char kPyramids[] = "Pyramids of the methods phs, hs and importance";
constexpr char kPlace[] = "Where it runs";
constexpr char kMeasure[] = "Measured error";
constexpr char kTerminal[] = "Terminal";

// A check without a name of its own, so that --help shows only our words.
CLI::Validator Check(std::function<std::string(std::string&)> check) {
  return CLI::Validator(std::move(check), "");
}

bool ReadNumber(const std::string& text, double& value) {
  const char* end = text.data() + text.size();
  auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end && std::isfinite(value);
}

CLI::Validator NumberFrom(double low, double high = std::numeric_limits<double>::infinity()) {
  return Check([low, high](std::string& text) -> std::string {
    double value = 0;
    if (ReadNumber(text, value) && value >= low && value <= high) return "";
    if (std::isinf(high)) return fmt::format("'{}' is not a number of at least {}", text, low);
    return fmt::format("'{}' is not a number from {} to {}", text, low, high);
  });
}

// Whole numbers; also as 1e7, and with k, M or G for thousands, millions, billions.
CLI::Validator CountFrom(int64_t low, int64_t high) {
  return Check([low, high](std::string& text) -> std::string {
    const std::string given = text;
    std::string digits = text;
    double scale = 1;
    if (!digits.empty()) {
      const char suffix = digits.back();
      scale = suffix == 'k' ? 1e3 : suffix == 'M' ? 1e6 : suffix == 'G' ? 1e9 : 1;
      if (scale > 1) digits.pop_back();
    }
    double value = 0;
    // 2^53: every whole number up to there is exact in a double.
    const bool is_count = ReadNumber(digits, value) && value * scale == std::floor(value * scale) &&
                          std::abs(value * scale) <= 9007199254740992.0;
    if (!is_count || value * scale < low || value * scale > high) {
      return fmt::format("'{}' is not a whole number from {} to {}", given, low, high);
    }
    text = fmt::format("{}", static_cast<int64_t>(value * scale));
    return "";
  });
}

CLI::Validator OneOf(const std::vector<std::string>& choices) {
  return Check([choices](std::string& text) -> std::string {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return "";
    return fmt::format("'{}' is not one of {}", text, fmt::join(choices, ", "));
  });
}

constexpr int64_t kAnyCount = 9007199254740992;  // 2^53

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
  CLI::Option* option = command.add_option_function<std::string>(
      std::string("--") + setting.name,
      [&setting, &shoot](const std::string& text) { setting.set(text, shoot); }, setting.help);
  option->option_text(setting.value_name)
      ->group(std::string(setting.name).starts_with("phs-") ? kPyramids : kMethod);
  if (std::string(setting.value_name) == "N") option->transform(CountFrom(0, kAnyCount));
  option->check(Check([&setting](std::string& text) { return CheckSetting(setting, text); }));
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

}  // namespace lambert::app

#include "app/bench_text.h"

#include <algorithm>

#include "app/measures_text.h"
#include "app/progress_text.h"
#include "app/service.h"
#include "fmt/format.h"
#include "nlohmann/json.hpp"
#include "radiosity/output/run_json.h"

namespace lambert::app {
namespace {

using Json = nlohmann::ordered_json;

template <typename Number>
Json OrNull(const std::optional<Number>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::string Percent(const std::optional<double>& value) {
  return value ? FormatPercent(*value) : "-";
}

std::string Factor(const std::optional<double>& value) {
  return value ? fmt::format("{:.3g}", *value) : "-";
}

// "+0.12 % +- 0.05 %"
std::string Bias(const BenchSummary& summary) {
  if (!summary.measures.power_bias) return "-";
  std::string text = fmt::format("{:+.2f} %", 100 * *summary.measures.power_bias);
  if (summary.power_bias_se) text += fmt::format(" +- {:.2f}", 100 * *summary.power_bias_se);
  return text;
}

// "1.04 (0.93 +- 0.12)"
std::string MeanZ2(const std::optional<Agreement>& agreement) {
  if (!agreement) return "-";
  std::string text = fmt::format("{:.2f}", agreement->mean_z2);
  if (!agreement->null_z2) return text;
  return text + fmt::format(" ({:.2f} +- {:.2f})", *agreement->null_z2, *agreement->null_z2_sd);
}

Json SummaryJson(const BenchSummary& s) {
  Json json = {{"method", s.method},
               {"budget", s.budget},
               {"seeds", s.seeds},
               {"rays", s.rays},
               {"seconds", s.seconds},
               {"cpu_seconds", s.cpu_seconds},
               {"setup_seconds", s.setup_s},
               {"peak_rss_bytes", OrNull(s.peak_rss_bytes)},
               {"planned_worker_bytes", s.planned_worker_bytes}};
  json.update(MeasuresJson(s.measures));
  json["power_bias_se"] = OrNull(s.power_bias_se);
  const auto& z = s.agreement;
  json["z2_patches"] = z ? Json(z->patches) : Json(nullptr);
  json["mean_z2"] = z ? Json(z->mean_z2) : Json(nullptr);
  json["null_z2"] = z ? OrNull(z->null_z2) : Json(nullptr);
  json["null_z2_sd"] = z ? OrNull(z->null_z2_sd) : Json(nullptr);
  json["estimated_rms_area"] = OrNull(s.estimated_rms_area);
  json["estimated_over_true"] = OrNull(s.estimated_over_true);
  json["per_ray_area"] = OrNull(s.per_ray_area);
  json["per_ray_patch"] = OrNull(s.per_ray_patch);
  json["per_cpu_area"] = OrNull(s.per_cpu_area);
  json["per_cpu_patch"] = OrNull(s.per_cpu_patch);
  return json;
}

Json ResidualJson(const ErrorMeasures& residual) {
  return {{"rms_area", OrNull(residual.rms_area)},
          {"rms_patch", OrNull(residual.rms_patch)},
          {"rms_local", OrNull(residual.rms_local)}};
}

// Where the work was done: times are of there.
Json PlaceJson(const Options& options) {
  if (!options.server.empty()) return {{"server", options.server}};
  return {{"workers", options.workers}, {"threads", ThreadsPerWorker(options)}};
}

}  // namespace

std::string BenchHeadline(const BenchResult& result) {
  int seeds = 0;
  for (const BenchSummary& summary : result.summaries) seeds = std::max(seeds, summary.seeds);
  std::string text =
      fmt::format("{}: {} patches, {} {}; reference: {}, residual {}", result.name,
                  result.patches->size(), seeds, seeds == 1 ? "seed" : "seeds",
                  result.reference_origin, Percent(result.reference.residual.rms_area));
  if (result.reference.residual.rms_patch) {
    text += fmt::format(" (every patch alike: {})", Percent(result.reference.residual.rms_patch));
  }
  return text;
}

std::string BenchText(const BenchResult& result) {
  size_t width = 6;
  for (const BenchSummary& s : result.summaries) width = std::max(width, s.method.size());
  std::string text = BenchHeadline(result) + "\n";
  text +=
      fmt::format("{:<{}} {:>10} {:>8} {:>9} {:>9} {:>9} {:>9} {:>17} {:>19} {:>6} {:>7} {:>7}\n",
                  "method", width, "rays", "CPU s", "rms area", "rms patch", "rms local", "p95",
                  "power bias", "mean z2", "est.", "per ray", "per CPU");
  std::string budget;
  for (const BenchSummary& s : result.summaries) {
    if (!budget.empty() && s.budget != budget) text += "\n";
    budget = s.budget;
    text += fmt::format(
        "{:<{}} {:>10.0f} {:>8.3g} {:>9} {:>9} {:>9} {:>9} {:>17} {:>19} {:>6} {:>7} {:>7}\n",
        s.method, width, s.rays, s.cpu_seconds, Percent(s.measures.rms_area),
        Percent(s.measures.rms_patch), Percent(s.measures.rms_local), Percent(s.measures.p95),
        Bias(s), MeanZ2(s.agreement), Factor(s.estimated_over_true), Factor(s.per_ray_area),
        Factor(s.per_cpu_area));
  }
  for (const LeftOut& out : result.left_out) {
    text += "left out: " + out.label + ": " + out.why + "\n";
  }
  if (result.summaries.empty()) return text;
  return text +
         fmt::format(
             "mean z2: of the seeds' mean against the reference, and in brackets of each seed "
             "against "
             "the others, mean +- standard deviation: within 3 of those there is no sign of "
             "bias. est.: estimated over true rms area. per ray, per CPU: how many times the "
             "rays, or CPU time, of this {} takes for the same rms area.\n",
             result.summaries.front().method);
}

Json BenchJson(const Options& options, const BenchResult& result) {
  Json summaries = Json::array(), left_out = Json::array(), warnings = Json::array();
  for (const BenchSummary& summary : result.summaries) summaries.push_back(SummaryJson(summary));
  for (const LeftOut& out : result.left_out) {
    left_out.push_back({{"method", out.label}, {"why", out.why}});
  }
  for (const Warning& warning : result.warnings) {
    warnings.push_back({{"reason", warning.reason}, {"message", warning.message}});
  }
  Json json{{"name", result.name},
            {"folder", result.folder},
            {"scene_digest", result.scene_digest},
            {"patches", result.patches->size()},
            {"versions", {{"lambert", LAMBERT_VERSION}}},
            {"first_seed", options.solve.seed},
            {"seeds", options.bench.seeds},
            {"place", PlaceJson(options)},
            {"regions", options.regions},
            {"reference",
             {{"origin", result.reference_origin},
              {"file", result.reference_file},
              {"residual", ResidualJson(result.reference.residual)}}},
            {"interrupted", result.interrupted},
            {"summary", summaries},
            {"left_out", left_out},
            {"warnings", warnings}};
  json.update(PatchOptionsJson(options.patch));
  return json;
}

}  // namespace lambert::app

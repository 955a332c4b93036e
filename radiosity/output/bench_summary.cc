#include "radiosity/output/bench_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "radiosity/output/number_text.h"

namespace lambert {
namespace {

using Runs = std::vector<const BenchRun*>;
using Value = std::function<std::optional<double>(const BenchRun&)>;

// Empty where one run has no value. Requires: runs.
std::optional<double> MeanOf(const Runs& runs, const Value& value) {
  double sum = 0;
  for (const BenchRun* run : runs) {
    const std::optional<double> one = value(*run);
    if (!one) return std::nullopt;
    sum += *one;
  }
  return sum / static_cast<double>(runs.size());
}

std::optional<double> RootMeanSquare(const Runs& runs, const Value& value) {
  const std::optional<double> mean =
      MeanOf(runs, [&](const BenchRun& run) -> std::optional<double> {
        const std::optional<double> one = value(run);
        if (!one) return std::nullopt;
        return *one * *one;
      });
  if (!mean) return std::nullopt;
  return std::sqrt(*mean);
}

// sqrt(sum (x - mean)^2 / (n (n - 1))).
std::optional<double> StandardError(const Runs& runs, const Value& value) {
  const std::optional<double> mean = MeanOf(runs, value);
  if (!mean || runs.size() < 2) return std::nullopt;
  double squares = 0;
  for (const BenchRun* run : runs) squares += (*value(*run) - *mean) * (*value(*run) - *mean);
  const double n = static_cast<double>(runs.size());
  return std::sqrt(squares / (n * (n - 1)));
}

std::optional<double> Estimate(const BenchRun& run) {
  if (run.progress.estimated_rms_area < 0) return std::nullopt;
  return run.progress.estimated_rms_area;
}

std::optional<double> Ratio(std::optional<double> a, std::optional<double> b) {
  if (!a || !b || !(*b > 0)) return std::nullopt;
  return *a / *b;
}

// error^2 times what it took.
std::optional<double> Cost(std::optional<double> error, double effort) {
  if (!error) return std::nullopt;
  return *error * *error * effort;
}

ErrorMeasures SummarizeMeasures(const Runs& runs) {
  ErrorMeasures measures;
  measures.rms_area = RootMeanSquare(runs, [](const BenchRun& r) { return r.measures.rms_area; });
  measures.rms_patch = RootMeanSquare(runs, [](const BenchRun& r) { return r.measures.rms_patch; });
  measures.rms_local = RootMeanSquare(runs, [](const BenchRun& r) { return r.measures.rms_local; });
  measures.p95 = MeanOf(runs, [](const BenchRun& r) { return r.measures.p95; });
  measures.power_bias = MeanOf(runs, [](const BenchRun& r) { return r.measures.power_bias; });
  return measures;
}

std::optional<Agreement> AgreementOf(const Runs& runs, double rays, const PatchTable& reference) {
  std::vector<const Deviations*> deviations;
  for (const BenchRun* run : runs) deviations.push_back(&run->deviations);
  return Agree(deviations, rays, reference);
}

BenchSummary Summarize(const Runs& runs, const PatchTable& reference) {
  BenchSummary summary;
  summary.method = runs.front()->method;
  summary.budget = runs.front()->budget;
  summary.seeds = static_cast<int>(runs.size());
  summary.rays =
      *MeanOf(runs, [](const BenchRun& r) { return static_cast<double>(r.progress.rays); });
  summary.seconds = *MeanOf(runs, [](const BenchRun& r) { return r.progress.seconds; });
  summary.cpu_seconds = *MeanOf(runs, [](const BenchRun& r) { return r.progress.cpu_seconds; });
  summary.setup_s = *MeanOf(runs, [](const BenchRun& r) { return r.setup_s; });
  for (const BenchRun* run : runs) {
    summary.planned_worker_bytes =
        std::max(summary.planned_worker_bytes, run->planned_worker_bytes);
    // An empty optional is less than any value.
    summary.peak_rss_bytes = std::max(summary.peak_rss_bytes, run->peak_rss_bytes);
  }
  summary.measures = SummarizeMeasures(runs);
  summary.power_bias_se =
      StandardError(runs, [](const BenchRun& r) { return r.measures.power_bias; });
  summary.agreement = AgreementOf(runs, summary.rays * summary.seeds, reference);
  summary.estimated_rms_area = RootMeanSquare(runs, Estimate);
  summary.estimated_over_true = Ratio(summary.estimated_rms_area, summary.measures.rms_area);
  return summary;
}

void CompareToFirst(const BenchSummary& first, BenchSummary& summary) {
  const auto ratio = [&](std::optional<double> ErrorMeasures::*error,
                         double BenchSummary::*effort) {
    return Ratio(Cost(first.measures.*error, first.*effort),
                 Cost(summary.measures.*error, summary.*effort));
  };
  summary.per_ray_area = ratio(&ErrorMeasures::rms_area, &BenchSummary::rays);
  summary.per_ray_patch = ratio(&ErrorMeasures::rms_patch, &BenchSummary::rays);
  summary.per_cpu_area = ratio(&ErrorMeasures::rms_area, &BenchSummary::cpu_seconds);
  summary.per_cpu_patch = ratio(&ErrorMeasures::rms_patch, &BenchSummary::cpu_seconds);
}

template <typename Number>
void AppendCell(const std::optional<Number>& value, std::string& text) {
  text.push_back(',');
  if (value) AppendNumber(*value, text);
}

void AppendAgreement(const std::optional<Agreement>& agreement, std::string& text) {
  if (!agreement) {
    text += ",,,,";
    return;
  }
  text.push_back(',');
  AppendNumber(agreement->patches, text);
  text.push_back(',');
  AppendNumber(agreement->mean_z2, text);
  AppendCell(agreement->null_z2, text);
  AppendCell(agreement->null_z2_sd, text);
}

}  // namespace

std::vector<BenchSummary> SummarizeRuns(const std::vector<BenchRun>& runs,
                                        const PatchTable& reference) {
  std::vector<std::pair<std::string, std::string>> order;
  std::map<std::pair<std::string, std::string>, Runs> groups;
  for (const BenchRun& run : runs) {
    Runs& group = groups[{run.method, run.budget}];
    if (group.empty()) order.emplace_back(run.method, run.budget);
    group.push_back(&run);
  }
  std::vector<BenchSummary> summaries;
  for (const auto& key : order) summaries.push_back(Summarize(groups.at(key), reference));
  for (BenchSummary& summary : summaries) {
    const auto first =
        std::find_if(summaries.begin(), summaries.end(),
                     [&](const BenchSummary& other) { return other.budget == summary.budget; });
    CompareToFirst(*first, summary);
  }
  return summaries;
}

std::string EncodeSummaryCsv(const std::vector<BenchSummary>& summaries) {
  std::string text =
      "method,budget,seeds,rays,seconds,cpu_seconds,setup_seconds,peak_rss_bytes,"
      "planned_worker_bytes,rms_area,rms_patch,rms_local,p95,power_bias,power_bias_se,"
      "z2_patches,mean_z2,null_z2,null_z2_sd,estimated_rms_area,estimated_over_true,per_ray_area,"
      "per_ray_patch,per_cpu_area,"
      "per_cpu_patch\n";
  for (const BenchSummary& s : summaries) {
    text += s.method + "," + s.budget + ",";
    AppendNumber(s.seeds, text);
    for (double value : {s.rays, s.seconds, s.cpu_seconds, s.setup_s}) {
      text.push_back(',');
      AppendNumber(value, text);
    }
    AppendCell(s.peak_rss_bytes, text);
    text.push_back(',');
    AppendNumber(s.planned_worker_bytes, text);
    const ErrorMeasures& m = s.measures;
    for (const std::optional<double>& value :
         {m.rms_area, m.rms_patch, m.rms_local, m.p95, m.power_bias, s.power_bias_se}) {
      AppendCell(value, text);
    }
    AppendAgreement(s.agreement, text);
    for (const std::optional<double>& value :
         {s.estimated_rms_area, s.estimated_over_true, s.per_ray_area, s.per_ray_patch,
          s.per_cpu_area, s.per_cpu_patch}) {
      AppendCell(value, text);
    }
    text.push_back('\n');
  }
  return text;
}

}  // namespace lambert

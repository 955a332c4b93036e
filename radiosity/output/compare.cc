#include "radiosity/output/compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "radiosity/core/error.h"
#include "radiosity/solve/flux_ledger.h"

namespace lambert {
namespace {

// Areas of the same patch, computed by other means or read from other digits, differ by less.
constexpr double kAreaTolerance = 1e-6;
// Relative errors are not taken to less than this part of the mean reflected radiosity.
constexpr double kDarkestShare = 0.01;

using PatchKey = std::tuple<int32_t, int32_t, int32_t, int32_t, std::array<double, 9>>;

PatchKey KeyOf(const PatchTable& table, PatchIndex i) {
  const PatchSource& source = table.source[i];
  std::array<double, 9> corners;
  for (int c = 0; c < 3; ++c) {
    const Vec3& p = table.corners[i][c];
    corners[3 * c] = p.x;
    corners[3 * c + 1] = p.y;
    corners[3 * c + 2] = p.z;
  }
  return {source.node, source.mesh, source.primitive, source.triangle, corners};
}

bool PairedByIndex(const PatchTable& a, const PatchTable& b) {
  if (a.size() != b.size()) return false;
  for (PatchIndex i = 0; i < a.size(); ++i) {
    const double larger = std::max(a.area_m2[i], b.area_m2[i]);
    if (std::abs(a.area_m2[i] - b.area_m2[i]) > kAreaTolerance * larger) return false;
  }
  return true;
}

// One patch as the measures see it.
struct Row {
  double area_m2, error, reflected;  // error and reflected: mean of the channels [lm/m2]
};

// Area-weighted mean of what the patches reflect; empty where that is nothing.
std::optional<double> MeanReflected(const std::vector<Row>& rows) {
  CompensatedSum area, reflected;
  for (const Row& row : rows) {
    area.Add(row.area_m2);
    reflected.Add(row.area_m2 * row.reflected);
  }
  const double mean = reflected.value() / area.value();
  if (!(mean > 0)) return std::nullopt;
  return mean;
}

double RmsPatch(const std::vector<Row>& rows) {
  CompensatedSum squares;
  for (const Row& row : rows) squares.Add(row.error * row.error);
  return std::sqrt(squares.value() / static_cast<double>(rows.size()));
}

double RmsArea(const std::vector<Row>& rows) {
  CompensatedSum area, squares;
  for (const Row& row : rows) {
    area.Add(row.area_m2);
    squares.Add(row.area_m2 * row.error * row.error);
  }
  return std::sqrt(squares.value() / area.value());
}

// 95th percentile of the errors relative to what each patch reflects. Linear between the two values
// nearest to rank .95 (n - 1), as numpy.percentile. Requires: rows.
double RelativeP95(const std::vector<Row>& rows, double mean_reflected) {
  std::vector<double> values;
  for (const Row& row : rows) {
    const double scale = std::max(row.reflected, kDarkestShare * mean_reflected);
    values.push_back(std::abs(row.error) / scale);
  }
  const double rank = 0.95 * static_cast<double>(values.size() - 1);
  const size_t low = static_cast<size_t>(rank);
  std::nth_element(values.begin(), values.begin() + low, values.end());
  if (low + 1 == values.size()) return values[low];
  const double next = *std::min_element(values.begin() + low + 1, values.end());
  return values[low] + (rank - static_cast<double>(low)) * (next - values[low]);
}

}  // namespace

absl::StatusOr<std::vector<PatchIndex>> PairPatches(const PatchTable& table,
                                                    const PatchTable& reference) {
  std::vector<PatchIndex> partner(table.size());
  if (PairedByIndex(table, reference)) {
    for (PatchIndex i = 0; i < table.size(); ++i) partner[i] = i;
    return partner;
  }
  std::map<PatchKey, PatchIndex> by_key;
  for (PatchIndex i = 0; i < reference.size(); ++i) by_key.emplace(KeyOf(reference, i), i);
  PatchIndex lonely = 0;
  for (PatchIndex i = 0; i < table.size(); ++i) {
    const auto found = by_key.find(KeyOf(table, i));
    if (found == by_key.end()) {
      ++lonely;
    } else {
      partner[i] = found->second;
    }
  }
  if (lonely == 0 && table.size() == reference.size()) return partner;
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"TABLES_DIFFER", "reference",
                    std::to_string(lonely) + " of " + std::to_string(table.size()) +
                        " patches have no partner among its " + std::to_string(reference.size()),
                    "solve both for the same scene with the same --max-edge and --two-sided"});
}

absl::StatusOr<ErrorMeasures> Compare(const PatchTable& table, const PatchTable& reference,
                                      const std::set<int>& region_nodes) {
  const absl::StatusOr<std::vector<PatchIndex>> partner = PairPatches(table, reference);
  if (!partner.ok()) return partner.status();
  std::vector<Row> rows, region;
  CompensatedSum power, reference_power;
  for (PatchIndex i = 0; i < table.size(); ++i) {
    const PatchIndex r = (*partner)[i];
    const double area = reference.area_m2[r];
    if (!(area > 0)) continue;
    const Rgb difference = table.radiosity_lm_per_m2[i] - reference.radiosity_lm_per_m2[r];
    const Rgb reflected = reference.radiosity_lm_per_m2[r] - reference.exitance_lm_per_m2[r];
    rows.push_back({area, Mean(difference), Mean(reflected)});
    if (region_nodes.count(reference.source[r].node) > 0) region.push_back(rows.back());
    power.Add(area * Mean(table.reflectance[i] * table.irradiance_lx[i]));
    reference_power.Add(area * Mean(reference.reflectance[r] * reference.irradiance_lx[r]));
  }
  if (!region_nodes.empty() && region.empty()) {
    return MakeError(absl::StatusCode::kNotFound,
                     {"REGION_EMPTY", "--region", "no patch belongs to the nodes that it names",
                      "name a node that shows a mesh"});
  }
  ErrorMeasures measures;
  if (const std::optional<double> mean = MeanReflected(rows); mean) {
    measures.rms_area = RmsArea(rows) / *mean;
    measures.rms_patch = RmsPatch(rows) / *mean;
    measures.p95 = RelativeP95(rows, *mean);
  }
  if (const std::optional<double> mean = MeanReflected(region); mean) {
    measures.rms_local = RmsPatch(region) / *mean;
  }
  if (reference_power.value() > 0) {
    measures.power_bias = power.value() / reference_power.value() - 1;
  }
  return measures;
}

}  // namespace lambert

#include "radiosity/output/agreement.h"

#include <algorithm>
#include <cmath>

#include "radiosity/output/compare.h"
#include "radiosity/solve/flux_ledger.h"

namespace lambert {
namespace {

constexpr int kGreen = 1;

double Square(double x) { return x * x; }

// Of a patch's radiosity; 0 where it is not known.
double Variance(const PatchTable& table, PatchIndex i) {
  return Square(std::max(0.0, table.std_error_lm_per_m2[i][kGreen]));
}

// Part of all flux that is shot which arrives at each patch.
std::vector<double> HitShares(const PatchTable& reference) {
  CompensatedSum left, arrived;
  for (PatchIndex i = 0; i < reference.size(); ++i) {
    left.Add(reference.area_m2[i] * Mean(reference.radiosity_lm_per_m2[i]));
    arrived.Add(reference.area_m2[i] * Mean(reference.irradiance_lx[i]));
  }
  // Point lights leave no patch.
  const double shot = std::max(left.value(), arrived.value());
  std::vector<double> shares(reference.size());
  for (PatchIndex i = 0; i < reference.size() && shot > 0; ++i) {
    shares[i] = reference.area_m2[i] * Mean(reference.irradiance_lx[i]) / shot;
  }
  return shares;
}

// One patch over all runs.
struct PatchOverRuns {
  double mean = 0;      // of the differences
  double variance = 0;  // of one run, mean of what the runs state
};

PatchOverRuns OverRuns(const std::vector<const Deviations*>& runs, PatchIndex i) {
  PatchOverRuns over;
  for (const Deviations* run : runs) {
    over.mean += run->difference[i];
    over.variance += run->variance[i];
  }
  const double n = static_cast<double>(runs.size());
  return {over.mean / n, over.variance / n};
}

// Mean and standard deviation of z2 of each run against all.
void JudgeByEachOther(const std::vector<double>& z2, Agreement& agreement) {
  const double n = static_cast<double>(z2.size());
  double sum = 0, squares = 0;
  for (double one : z2) sum += one;
  for (double one : z2) squares += Square(one - sum / n);
  agreement.null_z2 = sum / n;
  agreement.null_z2_sd = std::sqrt(squares / (n - 1));
}

}  // namespace

absl::StatusOr<Deviations> DeviationsFrom(const PatchTable& table, const PatchTable& reference) {
  const absl::StatusOr<std::vector<PatchIndex>> partner = PairPatches(table, reference);
  if (!partner.ok()) return partner.status();
  Deviations deviations{std::vector<float>(reference.size()), std::vector<float>(reference.size())};
  for (PatchIndex i = 0; i < table.size(); ++i) {
    const PatchIndex r = (*partner)[i];
    deviations.difference[r] = static_cast<float>(table.radiosity_lm_per_m2[i][kGreen] -
                                                  reference.radiosity_lm_per_m2[r][kGreen]);
    deviations.variance[r] = static_cast<float>(Variance(table, i));
  }
  return deviations;
}

std::optional<Agreement> Agree(const std::vector<const Deviations*>& runs, double rays,
                               const PatchTable& reference) {
  const double n = static_cast<double>(runs.size());
  const std::vector<double> shares = HitShares(reference);
  Agreement agreement;
  std::vector<double> z2(runs.size());
  for (PatchIndex i = 0; i < reference.size(); ++i) {
    const PatchOverRuns patch = OverRuns(runs, i);
    if (shares[i] * rays < kEnoughHits || !(patch.variance > 0)) continue;
    ++agreement.patches;
    const double error2 = Variance(reference, i);
    agreement.mean_z2 += Square(patch.mean) / (patch.variance / n + error2);
    for (size_t k = 0; k < runs.size() && runs.size() > 1; ++k) {
      z2[k] += Square(runs[k]->difference[i] - patch.mean) / ((1 - 1 / n) * patch.variance);
    }
  }
  if (agreement.patches == 0) return std::nullopt;
  const double patches = static_cast<double>(agreement.patches);
  agreement.mean_z2 /= patches;
  for (double& one : z2) one /= patches;
  if (runs.size() > 1) JudgeByEachOther(z2, agreement);
  return agreement;
}

}  // namespace lambert

#include "radiosity/output/reference.h"

#include <cmath>
#include <utility>

namespace lambert {
namespace {

// sqrt(a^2 + b^2) / 2: the standard error of the mean of two.
Rgb ErrorOfMean(Rgb a, Rgb b) {
  Rgb mean;
  for (int channel = 0; channel < 3; ++channel) {
    mean[channel] = std::hypot(a[channel], b[channel]) / 2;
  }
  return a == kUnknownError || b == kUnknownError ? kUnknownError : mean;
}

// `off` against `reference`: the measures that scale with the error.
absl::StatusOr<ErrorMeasures> Residual(const PatchTable& off, const PatchTable& reference,
                                       const std::set<int>& region_nodes) {
  const absl::StatusOr<ErrorMeasures> measures = Compare(off, reference, region_nodes);
  if (!measures.ok()) return measures.status();
  return ErrorMeasures{measures->rms_area, measures->rms_patch, measures->rms_local, {}, {}};
}

}  // namespace

absl::StatusOr<Reference> JoinHalves(const PatchTable& a, const PatchTable& b,
                                     const std::set<int>& region_nodes) {
  Reference reference{a, {}};
  PatchTable& mean = reference.table;
  for (PatchIndex i = 0; i < a.size(); ++i) {
    mean.radiosity_lm_per_m2[i] = (a.radiosity_lm_per_m2[i] + b.radiosity_lm_per_m2[i]) * 0.5;
    mean.irradiance_lx[i] = (a.irradiance_lx[i] + b.irradiance_lx[i]) * 0.5;
    mean.std_error_lm_per_m2[i] = ErrorOfMean(a.std_error_lm_per_m2[i], b.std_error_lm_per_m2[i]);
  }
  // A half is off the mean by half the difference of both.
  absl::StatusOr<ErrorMeasures> residual = Residual(a, mean, region_nodes);
  if (!residual.ok()) return residual.status();
  reference.residual = *residual;
  return reference;
}

absl::StatusOr<Reference> JudgeReference(PatchTable table, const std::set<int>& region_nodes) {
  PatchTable off = table;  // every patch by one standard error
  for (PatchIndex i = 0; i < off.size(); ++i) {
    if (off.std_error_lm_per_m2[i] == kUnknownError) return Reference{std::move(table), {}};
    off.radiosity_lm_per_m2[i] = off.radiosity_lm_per_m2[i] + off.std_error_lm_per_m2[i];
  }
  absl::StatusOr<ErrorMeasures> residual = Residual(off, table, region_nodes);
  if (!residual.ok()) return residual.status();
  return Reference{std::move(table), *residual};
}

}  // namespace lambert

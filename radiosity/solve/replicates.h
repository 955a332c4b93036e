// Passes as independent replicates: their mean, weighted by rays, and what it is worth.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "radiosity/core/rgb.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/flux_ledger.h"
#include "radiosity/solve/solution.h"

namespace lambert {

// Pass p with N_p rays gives radiosity x_p with variance sigma^2 / N_p. The merged solution (FP93)
// is  x = sum N_p x_p / sum N_p,  and from P passes
//   sigma^2 ~ sum N_p (x_p - x)^2 / (P - 1),   Var(x) ~ sigma^2 / sum N_p.
class Replicates {
 public:
  // hits_are_rays: so that a patch without hits may yet have light (all methods but exact).
  explicit Replicates(const PatchSet& patches, bool hits_are_rays = true);

  // Requires: rays > 0.
  void Add(const FluxLedger& pass, int64_t rays);

  int32_t passes() const { return passes_; }
  // Mean solution; the standard errors of one pass are kUnknownError. That of a patch that no ray
  // has hit is what one ray more, of mean flux, would bring: of its true light no more is known.
  Solution Mean() const;
  // CONTRACT's rms_area and rms_patch of the mean, estimated; -1 with fewer than two passes; 0
  // where nothing is reflected.
  double EstimatedRmsArea() const { return EstimatedRms(/*by_area=*/true); }
  double EstimatedRmsPatch() const { return EstimatedRms(/*by_area=*/false); }

  std::string Encode() const;
  // DATA_LOSS, and nothing changes, on bytes that are not of this patch set.
  absl::Status Restore(const std::string& bytes);

 private:
  double EstimatedRms(bool by_area) const;
  Rgb MeanFluxOfRay() const;

  const PatchSet& patches_;
  const bool hits_are_rays_;
  int32_t passes_ = 0;
  double weight_ = 0;                // sum of N_p
  std::vector<Rgb> irradiance_lx_;   // mean
  std::vector<Rgb> spread_;          // sum N_p (x_p - x)^2 of the radiosity, per channel
  std::vector<double> gray_spread_;  // the same of the mean of its channels
  std::vector<int64_t> hits_;
  Ledger ledger_;  // mean
};

}  // namespace lambert

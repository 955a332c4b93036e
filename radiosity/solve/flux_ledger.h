// The flux of one pass: what is unsent, what has arrived, where the rest went.
#pragma once

#include <vector>

#include "radiosity/core/rgb.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/patch/surface_tree.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/solve/allocate.h"
#include "radiosity/solve/solution.h"

namespace lambert {

// A sum of doubles with its rounding error carried along (Neumaier).
class CompensatedSum {
 public:
  void Add(double value);
  double value() const { return sum_ + error_; }

 private:
  double sum_ = 0, error_ = 0;
};

// The flux of one sign, 1 or -1, as flux > 0.
std::vector<UnsentFlux> OfSign(const std::vector<UnsentFlux>& flux, int sign);
std::vector<UnsentFlux> Scaled(std::vector<UnsentFlux> flux, double factor);

class FluxLedger {
 public:
  // All emitters' emission is unsent: patches first, then lights. With a `tree` of the
  // patches, which must outlive the ledger, what arrived is what came to rest (UnitResult::rests).
  explicit FluxLedger(const PatchSet& patches, const SurfaceTree* tree = nullptr);

  // Emitters with unsent flux, in order. Negative flux takes back what was shot too much of; there
  // is none but after Add.
  const std::vector<UnsentFlux>& unsent() const { return unsent_; }
  // Whether some of it is negative.
  bool owes() const { return unsent_total_lm() > ChannelSum(unsent_sum_); }
  // Magnitudes, summed over emitters and channels.
  double unsent_total_lm() const { return ChannelSum(unsent_magnitude_); }
  double emitted_total_lm() const { return ChannelSum(emitted_); }

  // Books a step: the flux `sent`, times `sign`, has been shot as `plan` says and arrived as
  // `result` says; it is no longer unsent, but what arrived and is reflected is.
  void Book(const std::vector<UnsentFlux>& sent, const StepPlan& plan, const UnitResult& result,
            int sign = 1);

  // Adds signed flux, in order of emitters, to what is unsent. Whoever adds owes as much: over a
  // pass, what is added must come to nothing (radiosity/solve/ambient.h).
  void Add(const std::vector<UnsentFlux>& flux);

  // Makes residual flux unsent again, signed and in order of emitters.
  void TakeBack(const std::vector<UnsentFlux>& residual);

  // Books a finished solution of the light of `sent`, all of what is unsent or a part of it:
  // `result` holds all that arrived of it over all bounces, and nothing of it is left unsent.
  void BookSolution(const std::vector<UnsentFlux>& sent, const StepPlan& plan,
                    const UnitResult& result);

  // Flux arrived so far [lm], by patch: at it, or at elements and spread over their patches.
  std::vector<Rgb> ArrivedFlux() const;
  const std::vector<int64_t>& hits() const { return arrived_.hits; }
  Ledger Balance() const;

 private:
  void AddUnsent(int32_t emitter, Rgb flux_lm);
  void ClearUnsent();

  const PatchSet& patches_;
  const SurfaceTree* tree_;  // null: flux rests where it arrives
  Rgb emitted_;
  std::vector<UnsentFlux> unsent_;
  Rgb unsent_sum_, unsent_magnitude_;
  Arrived arrived_;  // by patch
  Arrived rested_;   // by place of the tree
  CompensatedSum absorbed_[3], escaped_[3], residual_[3];
};

}  // namespace lambert

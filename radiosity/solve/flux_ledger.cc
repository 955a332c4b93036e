#include "radiosity/solve/flux_ledger.h"

#include <algorithm>
#include <cmath>

namespace lambert {

void CompensatedSum::Add(double value) {
  const double next = sum_ + value;
  error_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - next) + value : (value - next) + sum_;
  sum_ = next;
}

FluxLedger::FluxLedger(const PatchSet& patches)
    : patches_(patches),
      emitted_(EmittedFlux(patches)),
      unsent_lm_(patches.size() + patches.point_lights.size()),
      arrived_lm_(patches.size()),
      hits_(patches.size()) {
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    unsent_lm_[i] = patches.exitance_lm_per_m2[i] * patches.area_m2[i];
  }
  for (size_t l = 0; l < patches.point_lights.size(); ++l) {
    unsent_lm_[patches.size() + l] = patches.point_lights[l].intensity_cd * (4 * M_PI);
  }
  for (const Rgb& flux : unsent_lm_) unsent_ = unsent_ + flux;
}

void FluxLedger::Book(const StepPlan& plan, const UnitResult& result) {
  const Rgb quantum = plan.quantum_lm;
  const Rgb unsent_before = unsent_;
  std::fill(unsent_lm_.begin(), unsent_lm_.end(), Rgb{});
  unsent_ = {};
  Rgb absorbed;
  for (PatchIndex i = 0; i < patches_.size(); ++i) {
    const Deposit& deposit = result.deposits[i];
    if (deposit.hits == 0) continue;
    hits_[i] += deposit.hits;
    const Rgb arrived{static_cast<double>(deposit.r) * quantum.r,
                      static_cast<double>(deposit.g) * quantum.g,
                      static_cast<double>(deposit.b) * quantum.b};
    arrived_lm_[i] = arrived_lm_[i] + arrived;
    unsent_lm_[i] = patches_.reflectance[i] * arrived;
    unsent_ = unsent_ + unsent_lm_[i];
    absorbed = absorbed + (arrived - unsent_lm_[i]);
  }
  for (int c = 0; c < 3; ++c) {
    absorbed_[c].Add(absorbed[c]);
    escaped_[c].Add(static_cast<double>(result.escaped[c]) * quantum[c]);
    // What roulette and rounding shot too little, positive, or too much, negative.
    residual_[c].Add(unsent_before[c]);
    residual_[c].Add(-static_cast<double>(result.shot[c]) * quantum[c]);
  }
}

Ledger FluxLedger::Balance() const {
  Ledger ledger;
  ledger.emitted = emitted_;
  ledger.unsent = unsent_;
  for (int c = 0; c < 3; ++c) {
    ledger.absorbed[c] = absorbed_[c].value();
    ledger.escaped[c] = escaped_[c].value();
    ledger.residual[c] = residual_[c].value();
  }
  return ledger;
}

}  // namespace lambert

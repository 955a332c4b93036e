#include "radiosity/solve/flux_ledger.h"

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
}

double FluxLedger::Total(const std::vector<Rgb>& flux) {
  CompensatedSum sum;
  for (const Rgb& f : flux) sum.Add(f.r + f.g + f.b);
  return sum.value();
}

void FluxLedger::Book(const StepPlan& plan, const UnitResult& result) {
  for (int c = 0; c < 3; ++c) {
    const double quantum = plan.quantum_lm[c];
    // Residual: what roulette and rounding shot too little, positive, or too much, negative.
    for (Rgb& unsent : unsent_lm_) {
      residual_[c].Add(unsent[c]);
      unsent[c] = 0;
    }
    residual_[c].Add(-static_cast<double>(result.shot[c]) * quantum);
    escaped_[c].Add(static_cast<double>(result.escaped[c]) * quantum);
  }
  for (PatchIndex i = 0; i < patches_.size(); ++i) {
    const Deposit& deposit = result.deposits[i];
    if (deposit.hits == 0) continue;
    hits_[i] += deposit.hits;
    const Rgb quantum = plan.quantum_lm;
    const Rgb arrived{static_cast<double>(deposit.r) * quantum.r,
                      static_cast<double>(deposit.g) * quantum.g,
                      static_cast<double>(deposit.b) * quantum.b};
    arrived_lm_[i] = arrived_lm_[i] + arrived;
    unsent_lm_[i] = patches_.reflectance[i] * arrived;
    for (int c = 0; c < 3; ++c) absorbed_[c].Add(arrived[c] - unsent_lm_[i][c]);
  }
}

Ledger FluxLedger::Balance() const {
  Ledger ledger;
  ledger.emitted = emitted_;
  CompensatedSum unsent[3];
  for (const Rgb& flux : unsent_lm_) {
    for (int c = 0; c < 3; ++c) unsent[c].Add(flux[c]);
  }
  for (int c = 0; c < 3; ++c) {
    ledger.absorbed[c] = absorbed_[c].value();
    ledger.escaped[c] = escaped_[c].value();
    ledger.unsent[c] = unsent[c].value();
    ledger.residual[c] = residual_[c].value();
  }
  return ledger;
}

}  // namespace lambert

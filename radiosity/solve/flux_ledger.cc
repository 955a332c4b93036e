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
      arrived_lm_(patches.size()),
      hits_(patches.size()) {
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    AddUnsent(i, patches.exitance_lm_per_m2[i] * patches.area_m2[i]);
  }
  for (size_t l = 0; l < patches.point_lights.size(); ++l) {
    AddUnsent(patches.size() + static_cast<int32_t>(l),
              patches.point_lights[l].intensity_cd * (4 * M_PI));
  }
}

void FluxLedger::AddUnsent(int32_t emitter, Rgb flux_lm) {
  if (flux_lm == Rgb{}) return;
  unsent_.push_back({emitter, flux_lm});
  unsent_sum_ = unsent_sum_ + flux_lm;
}

Rgb FluxLedger::Arrive(const Deposit& deposit, const Rgb& quantum_lm) {
  const PatchIndex i = deposit.patch;
  hits_[i] += deposit.hits;
  const Rgb arrived{static_cast<double>(deposit.r) * quantum_lm.r,
                    static_cast<double>(deposit.g) * quantum_lm.g,
                    static_cast<double>(deposit.b) * quantum_lm.b};
  arrived_lm_[i] = arrived_lm_[i] + arrived;
  return arrived;
}

void FluxLedger::Book(const StepPlan& plan, const UnitResult& result) {
  const Rgb quantum = plan.quantum_lm;
  const Rgb unsent_before = unsent_sum_;
  unsent_.clear();
  unsent_sum_ = {};
  Rgb absorbed;
  for (const Deposit& deposit : result.deposits) {
    const Rgb arrived = Arrive(deposit, quantum);
    const Rgb reflected = patches_.reflectance[deposit.patch] * arrived;
    absorbed = absorbed + (arrived - reflected);
    AddUnsent(deposit.patch, reflected);
  }
  for (int c = 0; c < 3; ++c) {
    absorbed_[c].Add(absorbed[c]);
    escaped_[c].Add(static_cast<double>(result.escaped[c]) * quantum[c]);
    // What roulette and rounding shot too little, positive, or too much, negative.
    residual_[c].Add(unsent_before[c]);
    residual_[c].Add(-static_cast<double>(result.shot[c]) * quantum[c]);
  }
}

void FluxLedger::BookSolution(const StepPlan& plan, const UnitResult& result) {
  const Rgb emitted = unsent_sum_;
  unsent_.clear();
  unsent_sum_ = {};
  CompensatedSum absorbed[3];
  for (const Deposit& deposit : result.deposits) {
    const Rgb arrived = Arrive(deposit, plan.quantum_lm);
    const Rgb kept = arrived - patches_.reflectance[deposit.patch] * arrived;
    for (int c = 0; c < 3; ++c) absorbed[c].Add(kept[c]);
  }
  for (int c = 0; c < 3; ++c) {
    const double escaped = static_cast<double>(result.escaped[c]) * plan.quantum_lm[c];
    absorbed_[c].Add(absorbed[c].value());
    escaped_[c].Add(escaped);
    residual_[c].Add(emitted[c] - absorbed[c].value() - escaped);  // of rounding
  }
}

Ledger FluxLedger::Balance() const {
  Ledger ledger;
  ledger.emitted = emitted_;
  ledger.unsent = unsent_sum_;
  for (int c = 0; c < 3; ++c) {
    ledger.absorbed[c] = absorbed_[c].value();
    ledger.escaped[c] = escaped_[c].value();
    ledger.residual[c] = residual_[c].value();
  }
  return ledger;
}

}  // namespace lambert

#include "radiosity/solve/flux_ledger.h"

#include <cmath>

namespace lambert {
namespace {

Rgb InLumen(const Deposit& deposit, const Rgb& quantum_lm) {
  return {static_cast<double>(deposit.r) * quantum_lm.r,
          static_cast<double>(deposit.g) * quantum_lm.g,
          static_cast<double>(deposit.b) * quantum_lm.b};
}

void Add(const std::vector<Deposit>& deposits, const Rgb& quantum_lm, Arrived& sum) {
  for (const Deposit& deposit : deposits) {
    const auto place = static_cast<size_t>(deposit.patch);
    if (place >= sum.hits.size()) continue;  // no such element: a forged result
    sum.flux_lm[place] = sum.flux_lm[place] + InLumen(deposit, quantum_lm);
    sum.hits[place] += deposit.hits;
  }
}

}  // namespace

void CompensatedSum::Add(double value) {
  const double next = sum_ + value;
  error_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - next) + value : (value - next) + sum_;
  sum_ = next;
}

FluxLedger::FluxLedger(const PatchSet& patches, const SurfaceTree* tree)
    : patches_(patches),
      tree_(tree),
      emitted_(EmittedFlux(patches)),
      arrived_(patches.size()),
      rested_(tree != nullptr ? tree->place_count() : 0) {
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

std::vector<Rgb> FluxLedger::ArrivedFlux() const {
  return tree_ != nullptr ? tree_->PushDown(rested_, arrived_) : arrived_.flux_lm;
}

void FluxLedger::Book(const StepPlan& plan, const UnitResult& result) {
  const Rgb quantum = plan.quantum_lm;
  const Rgb unsent_before = unsent_sum_;
  unsent_.clear();
  unsent_sum_ = {};
  Rgb absorbed;
  for (const Deposit& deposit : result.deposits) {
    const Rgb arrived = InLumen(deposit, quantum);
    const Rgb reflected = patches_.reflectance[deposit.patch] * arrived;
    absorbed = absorbed + (arrived - reflected);
    AddUnsent(deposit.patch, reflected);
  }
  Add(result.deposits, quantum, arrived_);
  if (tree_ != nullptr) Add(result.rests, quantum, rested_);
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
  Add(result.deposits, plan.quantum_lm, arrived_);
  CompensatedSum absorbed[3];
  for (const Deposit& deposit : result.deposits) {
    const Rgb arrived = InLumen(deposit, plan.quantum_lm);
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

#include "radiosity/solve/flux_ledger.h"

#include <algorithm>
#include <cmath>

#include "radiosity/patch/light.h"

namespace lambert {
namespace {

void AddDeposits(const std::vector<Deposit>& deposits, const Rgb& quantum_lm, Arrived& sum) {
  for (const Deposit& deposit : deposits) {
    const auto place = static_cast<size_t>(deposit.patch);
    if (place >= sum.hits.size()) continue;  // no such element: a forged result
    sum.flux_lm[place] = sum.flux_lm[place] + InLumen(deposit.quanta(), quantum_lm);
    sum.hits[place] += deposit.hits;
  }
}

// Two lists in order of emitters as one.
std::vector<UnsentFlux> Merged(const std::vector<UnsentFlux>& a, const std::vector<UnsentFlux>& b) {
  std::vector<UnsentFlux> sum;
  sum.reserve(a.size() + b.size());
  auto from_a = a.begin(), from_b = b.begin();
  while (from_a != a.end() || from_b != b.end()) {
    if (from_b == b.end() || (from_a != a.end() && from_a->emitter < from_b->emitter)) {
      sum.push_back(*from_a++);
    } else if (from_a == a.end() || from_b->emitter < from_a->emitter) {
      sum.push_back(*from_b++);
    } else {
      sum.push_back({from_a->emitter, from_a->flux_lm + from_b->flux_lm});
      ++from_a;
      ++from_b;
    }
  }
  return sum;
}

}  // namespace

std::vector<UnsentFlux> OfSign(const std::vector<UnsentFlux>& flux, int sign) {
  std::vector<UnsentFlux> part;
  for (const auto& [emitter, lm] : flux) {
    Rgb of_sign;
    for (int c = 0; c < 3; ++c) of_sign[c] = std::max(0.0, sign * lm[c]);
    if (of_sign != Rgb{}) part.push_back({emitter, of_sign});
  }
  return part;
}

std::vector<UnsentFlux> Scaled(std::vector<UnsentFlux> flux, double factor) {
  for (UnsentFlux& unsent : flux) unsent.flux_lm = unsent.flux_lm * factor;
  return flux;
}

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
  int32_t emitter = patches.size();
  for (const Rgb& flux_lm : LightFlux(patches)) AddUnsent(emitter++, flux_lm);
}

void FluxLedger::AddUnsent(int32_t emitter, Rgb flux_lm) {
  if (flux_lm == Rgb{}) return;
  unsent_.push_back({emitter, flux_lm});
  unsent_sum_ = unsent_sum_ + flux_lm;
  unsent_magnitude_ = unsent_magnitude_ + Abs(flux_lm);
}

void FluxLedger::ClearUnsent() {
  unsent_.clear();
  unsent_sum_ = unsent_magnitude_ = {};
}

void FluxLedger::Add(const std::vector<UnsentFlux>& flux) {
  const std::vector<UnsentFlux> sum = Merged(unsent_, flux);
  ClearUnsent();
  for (const UnsentFlux& unsent : sum) AddUnsent(unsent.emitter, unsent.flux_lm);
}

std::vector<Rgb> FluxLedger::ArrivedFlux() const {
  return tree_ != nullptr ? tree_->PushDown(rested_, arrived_) : arrived_.flux_lm;
}

void FluxLedger::Book(const std::vector<UnsentFlux>& sent, const StepPlan& plan,
                      const UnitResult& result, int sign) {
  const Rgb quantum = plan.quantum_lm * sign;
  Rgb sent_sum;
  for (const UnsentFlux& flux : sent) sent_sum = sent_sum + flux.flux_lm * sign;
  const bool all = sign > 0 && !owes() && sent.size() == unsent_.size();
  std::vector<UnsentFlux> left;
  if (!all) left = Merged(unsent_, Scaled(sent, -sign));
  ClearUnsent();
  Rgb absorbed;
  for (const Deposit& deposit : result.deposits) {
    const Rgb arrived = InLumen(deposit.quanta(), quantum);
    const Rgb reflected = patches_.reflectance[deposit.patch] * arrived;
    absorbed = absorbed + (arrived - reflected);
    AddUnsent(deposit.patch, reflected);
  }
  if (!left.empty()) Add(left);
  AddDeposits(result.deposits, quantum, arrived_);
  if (tree_ != nullptr) AddDeposits(result.rests, quantum, rested_);
  for (int c = 0; c < 3; ++c) {
    absorbed_[c].Add(absorbed[c]);
    escaped_[c].Add(InLumen(result.escaped, quantum)[c]);
    // What roulette and rounding shot too little, positive, or too much, negative.
    residual_[c].Add(sent_sum[c]);
    residual_[c].Add(-InLumen(result.shot, quantum)[c]);
  }
}

void FluxLedger::TakeBack(const std::vector<UnsentFlux>& residual) {
  for (const UnsentFlux& flux : residual) {
    for (int c = 0; c < 3; ++c) residual_[c].Add(-flux.flux_lm[c]);
  }
  Add(residual);
}

void FluxLedger::BookSolution(const std::vector<UnsentFlux>& sent, const StepPlan& plan,
                              const UnitResult& result) {
  Rgb emitted;
  for (const UnsentFlux& flux : sent) emitted = emitted + flux.flux_lm;
  Add(Scaled(sent, -1));
  AddDeposits(result.deposits, plan.quantum_lm, arrived_);
  CompensatedSum absorbed[3];
  for (const Deposit& deposit : result.deposits) {
    const Rgb arrived = InLumen(deposit.quanta(), plan.quantum_lm);
    const Rgb kept = arrived - patches_.reflectance[deposit.patch] * arrived;
    for (int c = 0; c < 3; ++c) absorbed[c].Add(kept[c]);
  }
  for (int c = 0; c < 3; ++c) {
    const double escaped = InLumen(result.escaped, plan.quantum_lm)[c];
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

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "radiosity/shoot/flight.h"
#include "radiosity/solve/flux_ledger.h"
#include "tests/support/landed_rays.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

// A Cornell box of any reflectances, of any emission from denormals up to 2^900 lm.
PatchSet AnyPatches(TestRandom& random) {
  PatchSet patches = PatchesOf(MakeCornell(1));
  const double scale = std::ldexp(1, static_cast<int>(random.Below(1960)) - 1060);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    patches.reflectance[i] = {random.Uniform(), random.Uniform(), random.Uniform()};
    Rgb& exitance = patches.exitance_lm_per_m2[i];
    if (random.Below(3) == 0) exitance = {random.Uniform(), 0, random.Uniform()};
    exitance = exitance * scale;
  }
  return patches;
}

// The plan's rays, all landed anywhere, as results of units that share them at random.
std::vector<UnitResult> Land(const StepPlan& plan, PatchIndex patches, TestRandom& random) {
  std::vector<std::vector<LandedRay>> units(1 + random.Below(6));
  for (const Visit& visit : plan.visits) {
    const RayDeal deal(visit.quanta, visit.ray_count);
    for (uint32_t ray = 0; ray < visit.ray_count; ++ray) {
      const Long4 flux = deal.Of(ray);
      const auto to = static_cast<PatchIndex>(random.Below(patches + 1) - 1);
      units[random.Below(static_cast<int64_t>(units.size()))].push_back(
          {to, {flux[0], flux[1], flux[2]}});
    }
  }
  std::vector<UnitResult> results;
  for (const std::vector<LandedRay>& rays : units) results.push_back(ResultOf(rays));
  return results;
}

UnitResult MergedInAnyOrder(std::vector<UnitResult> results, TestRandom& random) {
  UnitResult merged;
  while (!results.empty()) {
    std::swap(results.back(), results[random.Below(static_cast<int64_t>(results.size()))]);
    MergeResult(results.back(), merged);
    results.pop_back();
  }
  return merged;
}

void AssertBalanced(const FluxLedger& ledger, int steps) {
  const Ledger b = ledger.Balance();
  for (int c = 0; c < 3; ++c) {
    const double scale = std::max({b.emitted[c], std::fabs(b.absorbed[c]), std::fabs(b.escaped[c]),
                                   std::fabs(b.unsent[c]), std::fabs(b.residual[c])});
    const double denormals = steps * 1000 * 0x1p-1074;  // what a reflected flux is rounded to
    RC_ASSERT(std::fabs(b.absorbed[c] + b.escaped[c] + b.unsent[c] + b.residual[c] -
                        b.emitted[c]) <= 1e-12 * scale + denormals);
  }
}

bool Equal(const FluxLedger& a, const FluxLedger& b) {
  const Ledger x = a.Balance(), y = b.Balance();
  return a.unsent() == b.unsent() && a.ArrivedFlux() == b.ArrivedFlux() && a.hits() == b.hits() &&
         x.absorbed == y.absorbed && x.escaped == y.escaped && x.unsent == y.unsent &&
         x.residual == y.residual;
}

// Steps of any size, of all or some of the flux, also of flux that is owed; residual flux taken
// back between them. Two ledgers hear of each step's units in different orders.
RC_GTEST_PROP(FluxLedger, BalancesAfterAnyStepsAndWhateverOrderUnitsArriveIn, ()) {
  TestRandom random(*rc::gen::arbitrary<uint64_t>());
  const PatchSet patches = AnyPatches(random);
  FluxLedger ledger(patches), other(patches);
  const double emitted = ledger.emitted_total_lm();
  const int steps = *rc::gen::inRange(0, 12);
  for (int step = 1; step <= steps; ++step) {
    if (random.Below(4) == 0) {
      std::vector<UnsentFlux> residual;
      for (PatchIndex i = 0; i < patches.size(); i += 1 + static_cast<int32_t>(random.Below(9))) {
        const double flux = emitted * random.Uniform(-0.1, 0.1);
        residual.push_back({i, {flux, 0, flux / 3}});
      }
      ledger.TakeBack(residual);
      other.TakeBack(residual);
    }
    for (int sign : {1, -1}) {
      std::vector<UnsentFlux> sent = OfSign(ledger.unsent(), sign);
      if (random.Below(3) == 0)
        sent.resize(static_cast<size_t>(random.Below(1 + std::ssize(sent))));
      const double per_ray = std::max(emitted / random.Uniform(1, 300), 0x1p-1074);
      const StepPlan plan = AllocateRays(sent, per_ray, random.Uniform());
      const std::vector<UnitResult> units = Land(plan, patches.size(), random);
      ledger.Book(sent, plan, MergedInAnyOrder(units, random), sign);
      other.Book(sent, plan, MergedInAnyOrder(units, random), sign);
    }
    AssertBalanced(ledger, step);
    RC_ASSERT(Equal(ledger, other));
  }
}

}  // namespace
}  // namespace lambert

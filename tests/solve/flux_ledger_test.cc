#include "radiosity/solve/flux_ledger.h"

#include <gtest/gtest.h>

#include <numbers>

#include "radiosity/shoot/shooter.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

TEST(CompensatedSum, KeepsWhatAPlainSumLoses) {
  CompensatedSum sum;
  for (double x : {1.0, 1e100, 1.0, -1e100}) sum.Add(x);
  EXPECT_EQ(sum.value(), 2);
}

TEST(CompensatedSum, OfAMillionTenthsIsRightToTheLastBit) {
  CompensatedSum sum;
  for (int k = 0; k < 1000000; ++k) sum.Add(0.1);
  EXPECT_EQ(sum.value(), static_cast<double>(1000000 * static_cast<long double>(0.1)));
}

TEST(FluxLedger, StartsWithAllEmissionUnsentPatchesFirst) {
  Scene scene = MakeCornell(1);
  scene.lights.push_back({"", {1, 1, 1}, {10, 20, 30}});
  const PatchSet patches = PatchesOf(scene);
  const FluxLedger ledger(patches);
  std::vector<UnsentFlux> emitting;
  Rgb sum;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    EXPECT_EQ(ledger.ArrivedFlux()[i], Rgb{});
    const Rgb flux_lm = patches.exitance_lm_per_m2[i] * patches.area_m2[i];
    if (flux_lm != Rgb{}) emitting.push_back({i, flux_lm});
    sum = sum + flux_lm;
  }
  ASSERT_EQ(ledger.unsent().size(), emitting.size() + 1);
  EXPECT_TRUE(std::equal(emitting.begin(), emitting.end(), ledger.unsent().begin()));
  EXPECT_EQ(ledger.unsent().back().emitter, patches.size());
  EXPECT_DOUBLE_EQ(ledger.unsent().back().flux_lm.g, 4 * std::numbers::pi * 20);
  sum = sum + ledger.unsent().back().flux_lm;
  EXPECT_NEAR(ledger.unsent_total_lm() / (sum.r + sum.g + sum.b), 1, 1e-14);
  EXPECT_NEAR(ledger.emitted_total_lm() / ledger.unsent_total_lm(), 1, 1e-14);
}

TEST(FluxLedger, BooksAStepByHand) {
  PatchSet patches = PatchesOf(MakeParallelSquares(0.5, 0.25));
  const FluxLedger before(patches);
  FluxLedger ledger(patches);
  // Of patch `lit`, twice: half reflected. The rest escapes.
  StepPlan plan;
  plan.quantum_lm = {0.25, 0.25, 0.25};
  UnitResult result;
  PatchIndex lit = 0;
  while (patches.reflectance[lit].r != 0.5) ++lit;
  result.deposits = {{2, 2, 2, 1, lit}};
  result.shot = {4, 4, 4};
  result.escaped = {2, 2, 2};
  ledger.Book(ledger.unsent(), plan, result);
  EXPECT_EQ(ledger.ArrivedFlux()[lit], (Rgb{0.5, 0.5, 0.5}));
  EXPECT_EQ(ledger.hits()[lit], 1);
  EXPECT_EQ(ledger.unsent(), (std::vector<UnsentFlux>{{lit, {0.25, 0.25, 0.25}}}));
  EXPECT_DOUBLE_EQ(ledger.unsent_total_lm(), 0.75);
  const Ledger balance = ledger.Balance();
  EXPECT_DOUBLE_EQ(balance.absorbed.g, 0.25);
  EXPECT_DOUBLE_EQ(balance.escaped.g, 0.5);
  EXPECT_DOUBLE_EQ(balance.unsent.g, 0.25);
  EXPECT_NEAR(balance.residual.g, before.emitted_total_lm() / 3 - 1, 1e-12);
}

TEST(FluxLedger, TakesBackWhatWasShotTooMuchOf) {
  const PatchSet patches = PatchesOf(MakeFurnace(0.5));
  FluxLedger ledger(patches);
  const FluxLedger before = ledger;
  EXPECT_FALSE(ledger.owes());
  ledger.Add({{3, {-4, -4, -4}}, {7, {1, 0, 0}}});
  EXPECT_TRUE(ledger.owes());
  const double emitted = before.unsent()[3].flux_lm.r;
  const Rgb left = Rgb{emitted, emitted, emitted} - Rgb{4, 4, 4};
  EXPECT_EQ(ledger.unsent()[3], (UnsentFlux{3, left}));
  EXPECT_EQ(OfSign(ledger.unsent(), -1), (std::vector<UnsentFlux>{{3, left * -1.0}}));
  EXPECT_EQ(OfSign(ledger.unsent(), 1).size(), ledger.unsent().size() - 1);

  // Half of what patch 3 owes is shot and arrives at patch 5: it arrives there as a loss.
  StepPlan plan;
  plan.quantum_lm = {0.5, 0.5, 0.5};
  UnitResult result;
  result.deposits = {{1, 1, 1, 1, 5}};
  result.shot = {1, 1, 1};
  ledger.Book({{3, left * -0.5}}, plan, result, -1);
  EXPECT_EQ(ledger.ArrivedFlux()[5], (Rgb{-0.5, -0.5, -0.5}));
  EXPECT_DOUBLE_EQ(ledger.unsent()[3].flux_lm.g, left.g / 2);
  EXPECT_DOUBLE_EQ(ledger.unsent()[5].flux_lm.g, emitted - 0.25);
  const Ledger b = ledger.Balance();
  EXPECT_DOUBLE_EQ(b.absorbed.b, -0.25);
  // What was added is still owed.
  EXPECT_NEAR(b.absorbed.b + b.escaped.b + b.unsent.b + b.residual.b, b.emitted.b - 4, 1e-12);
}

TEST(FluxLedger, ResidualFluxThatIsTakenBackIsUnsentAndNoResidual) {
  const PatchSet patches = PatchesOf(MakeFurnace(0.5));
  FluxLedger ledger(patches);
  ledger.TakeBack({{2, {1, 2, 3}}, {4, {-1, 0, 0}}});
  const Ledger b = ledger.Balance();
  EXPECT_DOUBLE_EQ(b.residual.b, -3);
  EXPECT_DOUBLE_EQ(b.residual.r, 0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(b.unsent[c] + b.residual[c], b.emitted[c], 1e-14);
}

TEST(Scaled, ScalesEveryChannel) {
  EXPECT_EQ(Scaled({{1, {1, -2, 3}}}, -2), (std::vector<UnsentFlux>{{1, {-2, 4, -6}}}));
}

// Two rays arrive at one patch and rest on the whole of its square: the light is on both patches of
// it, but only the patch that was hit reflects.
TEST(FluxLedger, ShowsLightWhereItRestsAndReflectsItWhereItArrived) {
  const PatchSet patches = PatchesOf(MakeParallelSquares(0.5, 0.25));
  const SurfaceTree tree(patches);
  FluxLedger ledger(patches, &tree);
  StepPlan plan;
  plan.quantum_lm = {0.25, 0.25, 0.25};
  UnitResult result;
  const PatchIndex hit = 1;
  result.deposits = {{8, 8, 8, 2, hit}};
  result.rests = {{8, 8, 8, 2, patches.size() + tree.ParentOf(hit)}};
  result.shot = {8, 8, 8};
  ledger.Book(ledger.unsent(), plan, result);
  ASSERT_EQ(ledger.unsent().size(), 1u);
  EXPECT_EQ(ledger.unsent()[0].emitter, hit);
  EXPECT_EQ(ledger.hits()[hit], 2);
  const std::vector<Rgb> arrived = ledger.ArrivedFlux();
  int lit = 0;
  for (const Rgb& flux : arrived) lit += flux.r > 0;
  EXPECT_EQ(lit, 2);
  EXPECT_DOUBLE_EQ(arrived[hit].r, 1);
}

// Steps of a Cornell box that is open in front, with the losses of roulette and of cosine weights.
TEST(FluxLedger, BalancesAfterEveryStepInEveryChannel) {
  const auto patches = std::make_shared<const PatchSet>(PatchesOf(MakeCornell(2)));
  ShootOptions pmcr, phs;
  phs.method = Method::kPhs;
  phs.pyramids.min_rays = 64;
  phs.pyramids.sampling = PyramidSampling::kSolidAngle;
  for (const ShootOptions& options : {pmcr, phs}) {
    const auto shooter = *Shooter::Create(patches, options);
    FluxLedger ledger(*patches);
    TestRandom random(1);
    const double emitted = ledger.emitted_total_lm();
    for (uint32_t step = 0; step < 40; ++step) {
      const StepPlan plan = AllocateRays(ledger.unsent(), emitted / 5000, random.Uniform());
      UnitResult merged;
      for (const WorkUnit& unit : CutIntoUnits(plan, 1, 0, step, 1000)) {
        MergeResult(*shooter->Run(unit), merged);
      }
      ledger.Book(ledger.unsent(), plan, merged);
      const Ledger b = ledger.Balance();
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(b.absorbed[c] + b.escaped[c] + b.unsent[c] + b.residual[c], b.emitted[c],
                    1e-12 * b.emitted[c])
            << "step " << step;
      }
      EXPECT_NEAR(b.unsent.r + b.unsent.g + b.unsent.b, ledger.unsent_total_lm(), 1e-12 * emitted);
    }
    EXPECT_GT(ledger.Balance().escaped.r, 0);
    EXPECT_LT(ledger.unsent_total_lm(), 1e-3 * emitted);
  }
}

}  // namespace
}  // namespace lambert

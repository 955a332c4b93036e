#include "radiosity/solve/replicates.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "tests/support/scenes.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

// Patches of unequal areas and reflectances.
const PatchSet& Patches() {
  static const PatchSet patches = PatchesOf(MakeCornell(1));
  return patches;
}

// A pass in which patch i received what `random` says.
FluxLedger RandomPass(const PatchSet& patches, TestRandom& random) {
  FluxLedger ledger(patches);
  StepPlan plan;
  plan.quantum_lm = {0x1p-20, 0x1p-21, 0x1p-22};
  UnitResult result;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    result.deposits.push_back(
        {random.Below(1 << 24), random.Below(1 << 24), random.Below(1 << 24), 1 + i, i});
    const Deposit& d = result.deposits.back();
    result.shot = {result.shot[0] + d.r, result.shot[1] + d.g, result.shot[2] + d.b};
  }
  ledger.Book(ledger.unsent(), plan, result);
  return ledger;
}

struct Pass {
  FluxLedger ledger;
  int64_t rays;
};
std::vector<Pass> RandomPasses(int count) {
  TestRandom random(1);
  std::vector<Pass> passes;
  for (int p = 0; p < count; ++p) {
    passes.push_back({RandomPass(Patches(), random), 100 + random.Below(1000)});
  }
  return passes;
}

Replicates Filled(const std::vector<Pass>& passes) {
  Replicates replicates(Patches());
  for (const Pass& pass : passes) replicates.Add(pass.ledger, pass.rays);
  return replicates;
}

// Radiosity of a patch after one pass: E + rho H, H = flux / area.
Rgb Radiosity(const Pass& pass, PatchIndex i) {
  return Patches().exitance_lm_per_m2[i] +
         Patches().reflectance[i] * pass.ledger.ArrivedFlux()[i] / Patches().area_m2[i];
}

// x = sum N_p x_p / sum N_p and Var(x) = sum N_p (x_p - x)^2 / (P - 1) / sum N_p.
struct Direct {
  double mean, variance;
};
template <typename Value>
Direct DirectFormula(const std::vector<Pass>& passes, Value value) {
  double weights = 0, mean = 0, spread = 0;
  for (const Pass& pass : passes) {
    weights += static_cast<double>(pass.rays);
    mean += static_cast<double>(pass.rays) * value(pass);
  }
  mean /= weights;
  for (const Pass& pass : passes) {
    spread += static_cast<double>(pass.rays) * std::pow(value(pass) - mean, 2);
  }
  return {mean, spread / static_cast<double>(passes.size() - 1) / weights};
}

TEST(Replicates, MeanAndStandardErrorAreTheDirectFormulas) {
  const std::vector<Pass> passes = RandomPasses(9);
  const Solution solution = Filled(passes).Mean();
  for (PatchIndex i = 0; i < Patches().size(); ++i) {
    int64_t hits = 0;
    for (const Pass& pass : passes) hits += pass.ledger.hits()[i];
    EXPECT_EQ(solution.hits[i], hits);
    for (int c = 0; c < 3; ++c) {
      const Direct b = DirectFormula(passes, [&](const Pass& p) { return Radiosity(p, i)[c]; });
      EXPECT_NEAR(solution.radiosity_lm_per_m2[i][c] / b.mean, 1, 1e-12);
      EXPECT_NEAR(solution.std_error_lm_per_m2[i][c] / std::sqrt(b.variance), 1, 1e-9);
      const Direct h = DirectFormula(passes, [&](const Pass& p) {
        return p.ledger.ArrivedFlux()[i][c] / Patches().area_m2[i];
      });
      EXPECT_NEAR(solution.irradiance_lx[i][c] / h.mean, 1, 1e-12);
    }
  }
}

TEST(Replicates, EstimatedErrorsAreThoseOfTheContract) {
  const std::vector<Pass> passes = RandomPasses(5);
  double area = 0, reflected = 0, by_area = 0, by_patch = 0;
  for (PatchIndex i = 0; i < Patches().size(); ++i) {
    const double a = Patches().area_m2[i];
    const Direct gray = DirectFormula(passes, [&](const Pass& p) { return Mean(Radiosity(p, i)); });
    area += a;
    reflected += a * (gray.mean - Mean(Patches().exitance_lm_per_m2[i]));
    by_area += a * gray.variance;
    by_patch += gray.variance;
  }
  const double mean_a = reflected / area, n = Patches().size();
  const Replicates replicates = Filled(passes);
  EXPECT_NEAR(replicates.EstimatedRmsArea() / (std::sqrt(by_area / area) / mean_a), 1, 1e-9);
  EXPECT_NEAR(replicates.EstimatedRmsPatch() / (std::sqrt(by_patch / n) / mean_a), 1, 1e-9);
}

TEST(Replicates, LedgerIsTheMeanOfTheLedgersAndBalances) {
  const std::vector<Pass> passes = RandomPasses(4);
  const Ledger ledger = Filled(passes).Mean().ledger;
  for (int c = 0; c < 3; ++c) {
    const Direct absorbed =
        DirectFormula(passes, [&](const Pass& p) { return p.ledger.Balance().absorbed[c]; });
    EXPECT_NEAR(ledger.absorbed[c] / absorbed.mean, 1, 1e-12);
    EXPECT_NEAR(ledger.absorbed[c] + ledger.escaped[c] + ledger.unsent[c] + ledger.residual[c],
                ledger.emitted[c], 1e-9 * std::abs(ledger.absorbed[c]));
  }
}

TEST(Replicates, KnowNoErrorBeforeTheSecondPass) {
  const std::vector<Pass> passes = RandomPasses(2);
  Replicates replicates(Patches());
  EXPECT_EQ(replicates.passes(), 0);
  EXPECT_EQ(replicates.EstimatedRmsArea(), -1);
  replicates.Add(passes[0].ledger, passes[0].rays);
  EXPECT_EQ(replicates.passes(), 1);
  EXPECT_EQ(replicates.EstimatedRmsArea(), -1);
  EXPECT_EQ(replicates.EstimatedRmsPatch(), -1);
  EXPECT_EQ(replicates.Mean().std_error_lm_per_m2[0], kUnknownError);
  replicates.Add(passes[1].ledger, passes[1].rays);
  EXPECT_GT(replicates.EstimatedRmsArea(), 0);
  EXPECT_GT(replicates.EstimatedRmsPatch(), 0);
}

// Two passes of one ray each, which brings 0.5 lm to the first of two squares: what a ray brings to
// their mean is half of that, and of the patches that got none no more is known.
TEST(Replicates, APatchThatNoRayHasHitMayYetHaveTheLightOfOne) {
  const PatchSet patches = PatchesOf(MakeParallelSquares(0.5, 0.25));
  StepPlan plan;
  plan.quantum_lm = {0.25, 0.25, 0.25};
  UnitResult result;
  result.deposits = {{2, 2, 2, 1, 0}};
  result.shot = {2, 2, 2};
  FluxLedger pass(patches);
  pass.Book(pass.unsent(), plan, result);
  for (bool hits_are_rays : {true, false}) {
    Replicates replicates(patches, hits_are_rays);
    replicates.Add(pass, 1);
    replicates.Add(pass, 1);
    const Solution solution = replicates.Mean();
    EXPECT_EQ(solution.std_error_lm_per_m2[0], Rgb{}) << "two equal passes";
    for (PatchIndex i = 1; i < patches.size(); ++i) {
      const double one_ray = patches.reflectance[i].g * 0.25 / patches.area_m2[i];
      EXPECT_DOUBLE_EQ(solution.std_error_lm_per_m2[i].g, hits_are_rays ? one_ray : 0);
    }
  }
}

// All that is known where every ray escaped is what a ray carried.
TEST(Replicates, WhereEveryRayEscapesAPatchMayYetHaveTheLightOfOne) {
  const PatchSet patches = PatchesOf(MakeParallelSquares(0.5, 0.25));
  StepPlan plan;
  plan.quantum_lm = {0.25, 0.25, 0.25};
  UnitResult result;
  result.shot = result.escaped = {8, 8, 8};
  FluxLedger pass(patches);
  pass.Book(pass.unsent(), plan, result);
  Replicates replicates(patches);
  replicates.Add(pass, 4);
  replicates.Add(pass, 4);
  const Solution solution = replicates.Mean();
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    EXPECT_DOUBLE_EQ(solution.std_error_lm_per_m2[i].g,
                     patches.reflectance[i].g * (2.0 / 8) / patches.area_m2[i]);
  }
}

TEST(Replicates, WithoutPassesAreTheEmission) {
  const Solution solution = Replicates(Patches()).Mean();
  EXPECT_EQ(solution.radiosity_lm_per_m2, Patches().exitance_lm_per_m2);
  EXPECT_EQ(solution.irradiance_lx, std::vector<Rgb>(Patches().size()));
}

TEST(Replicates, WhereNothingIsReflectedThereIsNoError) {
  PatchSet black = Patches();
  for (Rgb& rho : black.reflectance) rho = {};
  TestRandom random(3);
  Replicates replicates(black);
  replicates.Add(RandomPass(black, random), 10);
  replicates.Add(RandomPass(black, random), 10);
  EXPECT_EQ(replicates.EstimatedRmsArea(), 0);
  EXPECT_EQ(replicates.EstimatedRmsPatch(), 0);
}

TEST(Replicates, RestoredInTheMiddleContinueToTheSameBytes) {
  const std::vector<Pass> passes = RandomPasses(6);
  const std::string expected = Filled(passes).Encode();
  for (size_t k = 0; k <= passes.size(); ++k) {
    Replicates restored(Patches());
    ASSERT_TRUE(restored.Restore(Filled({passes.begin(), passes.begin() + k}).Encode()).ok());
    for (size_t p = k; p < passes.size(); ++p) restored.Add(passes[p].ledger, passes[p].rays);
    EXPECT_TRUE(restored.Encode() == expected) << "after " << k;
  }
}

TEST(Replicates, RefuseOtherBytesAndStayWhatTheyWere) {
  const std::vector<Pass> passes = RandomPasses(6);
  const std::string other = Filled({passes.begin() + 3, passes.end()}).Encode();
  Replicates replicates = Filled({passes.begin(), passes.begin() + 3});
  const std::string before = replicates.Encode();
  std::vector<std::string> broken = {"", other + '\0', other.substr(1),
                                     Replicates(PatchesOf(MakeFurnace(0.5))).Encode()};
  for (size_t size = 0; size < other.size(); size += 13) broken.push_back(other.substr(0, size));
  for (const std::string& bytes : broken) {
    const absl::Status status = replicates.Restore(bytes);
    ASSERT_EQ(status.code(), absl::StatusCode::kDataLoss);
    EXPECT_EQ(ReasonOf(status), "CHECKPOINT_INVALID");
    EXPECT_TRUE(replicates.Encode() == before) << bytes.size() << " bytes";
  }
}

}  // namespace
}  // namespace lambert

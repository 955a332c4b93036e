#include "radiosity/solve/solver.h"

#include <set>

#include "radiosity/core/error.h"
#include "tests/solve/run_solver.h"

namespace lambert {
namespace {

SharedPatches Cornell() {
  static const SharedPatches patches = Share(MakeCornell(2));
  return patches;
}

TEST(Solver, TheSameSeedGivesTheSameBytesAndAnotherSeedOthers) {
  for (Method method : ShootingMethods()) {
    SolverRun a(Cornell(), Budget(method, 60000, 7)), b(Cornell(), Budget(method, 60000, 7)),
        c(Cornell(), Budget(method, 60000, 8));
    for (SolverRun* run : {&a, &b, &c}) ASSERT_TRUE(run->ToTheEnd().ok());
    EXPECT_TRUE(a.SolutionBytes() == b.SolutionBytes());
    EXPECT_FALSE(a.SolutionBytes() == c.SolutionBytes());
  }
}

// The first step shoots floor(e + offset) rays, e with a fraction: each seed rounds by its own
// offset.
TEST(Solver, TheRoundingOfRayNumbersDependsOnTheSeed) {
  std::set<int64_t> first_step_rays;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    SolverRun run(Cornell(), Budget(Method::kPmcr, 1000, seed));
    ASSERT_TRUE(run.Pass().ok());
    first_step_rays.insert(run.steps[0].rays);
  }
  EXPECT_EQ(first_step_rays.size(), 2u);
  EXPECT_EQ(*first_step_rays.rbegin() - *first_step_rays.begin(), 1);
}

// What travels on is what phs sends on: only where arrived light is shown differs. So the flux that
// arrives, is absorbed and is reflected is that of phs to the last ray: no bias in power.
TEST(Solver, TheHierarchyKeepsThePowerOfFlatPhs) {
  const SharedPatches patches = Share(MakeCornell(6));
  SolverRun flat(patches, Budget(Method::kPhs, 100000)),
      hier(patches, Budget(Method::kPhsHier, 100000));
  ASSERT_TRUE(flat.ToTheEnd().ok() && hier.ToTheEnd().ok());
  const Solution a = *flat.solver.MakeSnapshot().solution, b = *hier.solver.MakeSnapshot().solution;
  EXPECT_EQ(a.hits, b.hits);
  EXPECT_EQ(a.ledger.absorbed, b.ledger.absorbed);
  EXPECT_FALSE(a.irradiance_lx == b.irradiance_lx);
  Rgb power_a, power_b;
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    power_a = power_a + a.radiosity_lm_per_m2[i] * patches->area_m2[i];
    power_b = power_b + b.radiosity_lm_per_m2[i] * patches->area_m2[i];
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(power_b[c] / power_a[c], 1, 1e-12);
}

TEST(Solver, RestoredAfterAnyPassContinuesToTheSameBytes) {
  for (Method method : ShootingMethods()) {
    const SolveOptions options = Budget(method, 200000);
    SolverRun whole(Cornell(), options);
    std::vector<std::string> checkpoints = {whole.solver.EncodeCheckpoint()};
    while (whole.solver.stop_reason() == StopReason::kNone) {
      ASSERT_TRUE(whole.Pass().ok());
      checkpoints.push_back(whole.solver.EncodeCheckpoint());
    }
    ASSERT_GT(checkpoints.size(), 3u);
    for (const std::string& checkpoint : checkpoints) {
      SolverRun resumed(Cornell(), options);
      ASSERT_TRUE(resumed.solver.Restore(checkpoint).ok());
      ASSERT_TRUE(resumed.ToTheEnd().ok());
      EXPECT_TRUE(resumed.SolutionBytes() == whole.SolutionBytes());
      const Snapshot a = resumed.solver.MakeSnapshot(), b = whole.solver.MakeSnapshot();
      EXPECT_EQ(a.version, b.version);
      EXPECT_EQ(a.progress.rays, b.progress.rays);
      EXPECT_EQ(a.progress.pass, b.progress.pass);
      EXPECT_EQ(a.progress.estimated_rms_area, b.progress.estimated_rms_area);
      EXPECT_EQ(resumed.solver.stop_reason(), whole.solver.stop_reason());
    }
  }
}

TEST(Solver, RefusesOtherBytesAsACheckpointAndStaysWhatItWas) {
  SolverRun run(Cornell(), Budget(Method::kPmcr, 60000)), other(Share(MakeFurnace(0.5)), {});
  ASSERT_TRUE(run.Pass().ok());
  const std::string good = run.solver.EncodeCheckpoint();
  for (const std::string& bytes :
       {std::string(), good.substr(0, good.size() - 1), good + '\0', good.substr(8),
        std::string(good.size(), 'x'), other.solver.EncodeCheckpoint()}) {
    const absl::Status status = run.solver.Restore(bytes);
    ASSERT_EQ(status.code(), absl::StatusCode::kDataLoss) << bytes.size();
    EXPECT_EQ(ReasonOf(status), "CHECKPOINT_INVALID");
    EXPECT_TRUE(run.solver.EncodeCheckpoint() == good);
  }
}

TEST(Solver, AfterNoPassKnowsTheEmissionOnly) {
  const SolverRun run(Cornell(), Budget(Method::kPmcr, 60000));
  const Snapshot snapshot = run.solver.MakeSnapshot();
  EXPECT_EQ(snapshot.version, 0);
  EXPECT_EQ(snapshot.progress.unsent_fraction, 1);
  EXPECT_EQ(snapshot.progress.rays, 0);
  EXPECT_EQ(snapshot.progress.estimated_rms_area, -1);
  EXPECT_EQ(snapshot.solution->radiosity_lm_per_m2, Cornell()->exitance_lm_per_m2);
}

TEST(Solver, TellsOfEveryStepAsFluxIsSentUntilTheTolerance) {
  SolveOptions options = Budget(Method::kPmcr, 100000);
  options.unsent_tolerance = 1e-3;
  SolverRun run(Cornell(), options);
  ASSERT_TRUE(run.Pass().ok());
  int32_t pass = 0, step = -1;
  int64_t rays = 0;
  for (const Progress& at : run.steps) {
    if (at.pass != pass) {
      EXPECT_EQ(at.pass, pass + 1);
      pass = at.pass;
      step = -1;
    }
    EXPECT_EQ(at.step, ++step);
    EXPECT_GT(at.rays, rays);
    rays = at.rays;
    EXPECT_EQ(at.max_rays, 100000);
  }
  EXPECT_EQ(pass, 1) << "a standard error needs two passes";
  EXPECT_GT(step, 3);
  EXPECT_LE(run.steps.back().unsent_fraction, 1e-3);
  EXPECT_GT(run.steps[run.steps.size() - 2].unsent_fraction, 1e-3);
  const Snapshot snapshot = run.solver.MakeSnapshot();
  EXPECT_EQ(snapshot.version, 1);
  EXPECT_EQ(snapshot.progress.rays, rays);
  EXPECT_GT(snapshot.progress.estimated_rms_area, 0);
  EXPECT_GT(snapshot.progress.estimated_rms_patch, 0);
}

TEST(Solver, BalancesItsLedgerAndMakesRadiosityOfIrradiance) {
  for (Method method : ShootingMethods()) {
    SolverRun run(Cornell(), Budget(method, 100000));
    ASSERT_TRUE(run.ToTheEnd().ok());
    const auto solution = run.solver.MakeSnapshot().solution;
    const Ledger& l = solution->ledger;
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(l.absorbed[c] + l.escaped[c] + l.unsent[c] + l.residual[c], l.emitted[c],
                  1e-12 * l.emitted[c]);
    }
    for (PatchIndex i = 0; i < Cornell()->size(); ++i) {
      EXPECT_EQ(solution->radiosity_lm_per_m2[i],
                Cornell()->exitance_lm_per_m2[i] +
                    Cornell()->reflectance[i] * solution->irradiance_lx[i]);
    }
  }
}

// Forges the results of a true shooter.
class ForgingShooter : public Shooter {
 public:
  explicit ForgingShooter(std::shared_ptr<const Shooter> true_one) : true_one_(true_one) {}
  absl::StatusOr<UnitResult> Run(const WorkUnit& unit) const override {
    absl::StatusOr<UnitResult> result = true_one_->Run(unit);
    if (result.ok()) ++result->shot[1];
    return result;
  }

 private:
  std::shared_ptr<const Shooter> true_one_;
};

TEST(SerialExecutor, RefusesABrokenLedger) {
  const SolveOptions options = Budget(Method::kPmcr, 60000);
  const auto shooter = *Shooter::Create(Cornell(), options.shoot);
  SerialExecutor forging(std::make_shared<ForgingShooter>(shooter));
  const absl::Status status = SolverRun(Cornell(), options).solver.RunPass(forging, nullptr);
  EXPECT_EQ(status.code(), absl::StatusCode::kDataLoss);
  EXPECT_EQ(ReasonOf(status), "RESULT_INVALID");
}

TEST(SerialExecutor, MergesTheResultsOfAllUnits) {
  const auto shooter = *Shooter::Create(Cornell(), {});
  std::vector<WorkUnit> units;
  UnitResult expected;
  for (PatchIndex i = 0; i < 5; ++i) {
    units.push_back({1, 0, 0, {{i, 100, 0, 100, {1000, 2000, 3000}}}});
    MergeResult(*shooter->Run(units.back()), expected);
  }
  const absl::StatusOr<UnitResult> merged = SerialExecutor(shooter).RunStep(units);
  ASSERT_TRUE(merged.ok());
  EXPECT_TRUE(EncodeUnitResult(*merged) == EncodeUnitResult(expected));
}

}  // namespace
}  // namespace lambert

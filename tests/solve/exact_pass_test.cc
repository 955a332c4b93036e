// Passes of the method exact: finished solutions, booked whole.
#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/core/error.h"
#include "tests/solve/run_solver.h"

namespace lambert {
namespace {

SolveOptions Exact(int64_t max_rays = 0, uint64_t seed = 1) {
  return Budget(Method::kExact, max_rays, seed);
}

TEST(ExactPass, GivesAFurnaceItsClosedForm) {
  for (const double rho : {0.1, 0.5, 0.9, 0.99}) {
    const SharedPatches patches = Share(MakeFurnace(rho, 1, 4));
    SolverRun run(patches, Exact());
    ASSERT_TRUE(run.ToTheEnd().ok());
    EXPECT_EQ(run.solver.stop_reason(), StopReason::kErrorReached);
    const Snapshot snapshot = run.solver.MakeSnapshot();
    for (const Rgb& b : snapshot.solution->radiosity_lm_per_m2) {
      EXPECT_NEAR(b.r * (1 - rho), 1, 1e-9) << rho;
      EXPECT_EQ(b, (Rgb{b.r, b.r, b.r}));
    }
    EXPECT_LT(snapshot.progress.estimated_rms_area, 1e-12);
  }
}

TEST(ExactPass, HoldsHighReflectancesInItsQuanta) {
  const double rho = 0.999999;
  SolverRun run(Share(MakeFurnace(rho, 1, 2)), Exact());
  ASSERT_TRUE(run.ToTheEnd().ok());
  const Snapshot snapshot = run.solver.MakeSnapshot();
  for (const Rgb& b : snapshot.solution->radiosity_lm_per_m2) {
    EXPECT_NEAR(b.r * (1 - rho), 1, 1e-5);
  }
}

TEST(ExactPass, RefusesAClosedSceneThatKeepsAllFlux) {
  SolverRun run(Share(MakeFurnace(1, 1, 2)), Exact());
  const absl::Status status = run.ToTheEnd();
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(ReasonOf(status), "SINGULAR_CLOSED_RHO_1");
}

TEST(ExactPass, BalancesItsLedger) {
  SolverRun run(Share(MakeCornell(2)), Exact(100000));
  ASSERT_TRUE(run.ToTheEnd().ok());
  const Ledger ledger = run.solver.MakeSnapshot().solution->ledger;
  EXPECT_EQ(ledger.unsent, Rgb{});
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(ledger.emitted[c],
                ledger.absorbed[c] + ledger.escaped[c] + ledger.unsent[c] + ledger.residual[c],
                1e-12 * ledger.emitted[c]);
    EXPECT_NEAR(ledger.residual[c], 0, 1e-12 * ledger.emitted[c]);
    EXPECT_GT(ledger.escaped[c], 0);
  }
}

TEST(ExactPass, SpendsABudgetOfRays) {
  SolverRun run(Share(MakeCornell(2)), Exact(200000));
  ASSERT_TRUE(run.ToTheEnd().ok());
  EXPECT_EQ(run.solver.stop_reason(), StopReason::kRaysSpent);
  EXPECT_NEAR(static_cast<double>(run.solver.MakeSnapshot().progress.rays), 200000, 4000);
}

TEST(ExactPass, ReachesAWantedError) {
  SolveOptions options = Exact();
  options.max_error = 0.001;
  SolverRun run(Share(MakeCornell(2)), options);
  ASSERT_TRUE(run.ToTheEnd().ok());
  EXPECT_EQ(run.solver.stop_reason(), StopReason::kErrorReached);
}

TEST(ExactPass, GoesOnFromACheckpointToTheSameBytes) {
  const SharedPatches patches = Share(MakeCornell(2));
  SolverRun whole(patches, Exact(400000)), first(patches, Exact(400000));
  ASSERT_TRUE(whole.ToTheEnd().ok());
  ASSERT_TRUE(first.Pass().ok());
  SolverRun second(patches, Exact(400000));
  ASSERT_TRUE(second.solver.Restore(first.solver.EncodeCheckpoint()).ok());
  ASSERT_TRUE(second.ToTheEnd().ok());
  EXPECT_EQ(second.SolutionBytes(), whole.SolutionBytes());
}

// A lamp at the centre of a cube lights each wall alike: Phi / 6, and with reflectance rho
// Phi / 6 / (1 - rho) over all bounces.
TEST(ExactPass, TakesPointLightsByTheirSolidAngle) {
  Scene scene = SceneMaker()
                    .Box({0, 0, 0}, {2, 2, 2}, true, {{{0.5, 0.25, 0}, {}}})
                    .Light({1, 1, 1}, {1, 2, 3})
                    .Make();
  const SharedPatches patches = Share(scene);
  SolverRun run(patches, Exact(100000));
  ASSERT_TRUE(run.ToTheEnd().ok());
  const Snapshot snapshot = run.solver.MakeSnapshot();
  for (PatchIndex i = 0; i < patches->size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double phi = 4 * M_PI * (c + 1), rho = patches->reflectance[i][c];
      const double expected = phi / 24 / (1 - rho);  // lx on 4 m2
      EXPECT_NEAR(snapshot.solution->irradiance_lx[i][c] / expected, 1, 1e-9);
    }
  }
}

TEST(ExactPass, LetsALightOnAWallShineIntoTheRoom) {
  const SharedPatches patches =
      Share(SceneMaker().Box({0, 0, 0}, {2, 2, 2}, true, {{}}).Light({1, 0, 1}, {1, 1, 1}).Make());
  SolverRun run(patches, Exact(100000));
  ASSERT_TRUE(run.ToTheEnd().ok());
  const Snapshot snapshot = run.solver.MakeSnapshot();
  // Half of 4 pi I, less what leaves at the flattest angles and rounds into the wall.
  EXPECT_NEAR(snapshot.solution->ledger.absorbed.g, 2 * M_PI, 0.02 * 2 * M_PI);
}

TEST(ExactPass, RefusesMorePatchesThanItsLimit) {
  ShootOptions options;
  options.method = Method::kExact;
  EXPECT_TRUE(options.ValidateFor(kMaxExactPatches).ok());
  const SharedPatches patches = Share(MakeFurnace(0.5, 1, 21));  // 5,292
  const auto shooter = Shooter::Create(patches, options);
  ASSERT_FALSE(shooter.ok());
  EXPECT_EQ(ReasonOf(shooter.status()), "FIELD_INVALID");
}

}  // namespace
}  // namespace lambert

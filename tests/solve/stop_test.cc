// When a run ends, and what it then keeps.
#include "radiosity/core/error.h"
#include "tests/solve/run_solver.h"

namespace lambert {
namespace {

SharedPatches Cornell() {
  static const SharedPatches patches = Share(MakeCornell(2));
  return patches;
}

TEST(Stop, AtTheWantedErrorAndNotFarPast) {
  for (Method method : {Method::kPmcr, Method::kPhs}) {
    SolveOptions options = Budget(method, 0);
    options.max_error = 0.02;
    SolverRun run(Cornell(), options);
    EXPECT_FALSE(run.solver.reached_goal());
    ASSERT_TRUE(run.ToTheEnd().ok());
    EXPECT_EQ(run.solver.stop_reason(), StopReason::kErrorReached);
    EXPECT_TRUE(run.solver.reached_goal());
    const Progress at = run.solver.MakeSnapshot().progress;
    EXPECT_LE(at.estimated_rms_area, 0.02);
    EXPECT_GT(at.estimated_rms_area, 0.01) << "four times the rays that were needed";
    EXPECT_EQ(at.wanted_rms_area, 0.02);
  }
}

TEST(Stop, WhereTheRaysAreSpent) {
  for (int64_t budget : {1000, 30000, 300000}) {
    SolverRun run(Cornell(), Budget(Method::kPmcr, budget));
    ASSERT_TRUE(run.ToTheEnd().ok());
    EXPECT_EQ(run.solver.stop_reason(), StopReason::kRaysSpent);
    EXPECT_TRUE(run.solver.reached_goal()) << "no error was wanted";
    const auto rays = static_cast<double>(run.solver.MakeSnapshot().progress.rays);
    const auto wanted = static_cast<double>(budget);
    // A pass's rays are known in advance from those before, as well as their number allows.
    EXPECT_LT(rays, wanted * (1 + 4 / std::sqrt(wanted))) << budget;
    EXPECT_GT(rays, 0.9 * wanted) << budget;
  }
}

TEST(Stop, WhereTheRaysAreSpentBeforeTheErrorIsReached) {
  SolveOptions options = Budget(Method::kPmcr, 5000);
  options.max_error = 1e-5;
  SolverRun run(Cornell(), options);
  ASSERT_TRUE(run.ToTheEnd().ok());
  EXPECT_EQ(run.solver.stop_reason(), StopReason::kRaysSpent);
  EXPECT_FALSE(run.solver.reached_goal());
}

TEST(Stop, WhereTheTimeIsSpent) {
  SolveOptions options = Budget(Method::kPmcr, 0);
  options.max_time_s = 60;
  SolverRun run(Cornell(), options);
  ASSERT_TRUE(run.ToTheEnd(/*step_s=*/0.25).ok());
  EXPECT_EQ(run.solver.stop_reason(), StopReason::kTimeSpent);
  const Progress at = run.solver.MakeSnapshot().progress;
  EXPECT_LE(at.seconds, 60.25);
  EXPECT_GT(at.seconds, 45);
  EXPECT_GT(at.estimated_rms_area, 0);
}

TEST(Stop, InTheMiddleOfTheFirstPassKeepsIt) {
  SolveOptions options = Budget(Method::kPmcr, 0);
  options.max_time_s = 1;
  SolverRun run(Cornell(), options);
  ASSERT_TRUE(run.ToTheEnd(/*step_s=*/0.6).ok());  // over after two steps
  EXPECT_EQ(run.solver.stop_reason(), StopReason::kTimeSpent);
  EXPECT_EQ(run.steps.size(), 2u);
  const Snapshot snapshot = run.solver.MakeSnapshot();
  EXPECT_GT(snapshot.solution->ledger.unsent.r, 0);
  EXPECT_NE(snapshot.solution->irradiance_lx, std::vector<Rgb>(Cornell()->size()));
}

TEST(Stop, WithoutAnEmitterTheSolutionIsZeroAtOnce) {
  SolverRun run(Share(MakeBox(1, {0.5, 0.5, 0.5}, std::vector<Rgb>(6))),
                Budget(Method::kPmcr, 1000));
  EXPECT_EQ(run.solver.stop_reason(), StopReason::kNothingToShoot);
  EXPECT_TRUE(run.solver.reached_goal());
  const Snapshot snapshot = run.solver.MakeSnapshot();
  EXPECT_EQ(snapshot.progress.unsent_fraction, 0);
  EXPECT_EQ(snapshot.solution->radiosity_lm_per_m2, std::vector<Rgb>(12));
  EXPECT_EQ(snapshot.solution->irradiance_lx, std::vector<Rgb>(12));
  ASSERT_TRUE(run.Pass().ok());
  EXPECT_EQ(run.solver.MakeSnapshot().version, 1);
}

TEST(Stop, AClosedSceneThatReflectsAllIsRefusedByName) {
  SolverRun run(Share(MakeFurnace(1)), Budget(Method::kPmcr, 100000));
  const absl::Status status = run.ToTheEnd();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  ASSERT_TRUE(GetErrorDetail(status).has_value());
  EXPECT_EQ(ReasonOf(status), "SINGULAR_CLOSED_RHO_1");
}

TEST(Stop, AnOpenSceneThatReflectsAllIsSolved) {
  SolverRun run(Share(MakeParallelSquares(1, 1)), Budget(Method::kPmcr, 20000));
  ASSERT_TRUE(run.ToTheEnd().ok());
  EXPECT_EQ(run.solver.stop_reason(), StopReason::kRaysSpent);
}

TEST(Stop, MoreStepsThanAllowedFailSayingSo) {
  SolveOptions options = Budget(Method::kPmcr, 100000);
  options.max_steps = 3;
  SolverRun run(Cornell(), options);
  const absl::Status status = run.ToTheEnd();
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(ReasonOf(status), "STEPS_EXHAUSTED");
}

// Cancels after a number of steps.
class CancellingExecutor : public StepExecutor {
 public:
  CancellingExecutor(StepExecutor& executor, int steps) : executor_(executor), left_(steps) {}
  absl::StatusOr<UnitResult> RunStep(const std::vector<WorkUnit>& units) override {
    if (left_-- == 0) return absl::CancelledError("cancelled");
    return executor_.RunStep(units);
  }

 private:
  StepExecutor& executor_;
  int left_;
};

TEST(Stop, CancelledInTheFirstPassKeepsWhatArrived) {
  SolverRun run(Cornell(), Budget(Method::kPmcr, 100000));
  CancellingExecutor executor(run.executor, 2);
  const absl::Status status = run.solver.RunPass(executor, nullptr);
  EXPECT_EQ(status.code(), absl::StatusCode::kCancelled);
  const auto solution = run.solver.MakeSnapshot().solution;
  EXPECT_GT(solution->ledger.absorbed.r, 0);
  EXPECT_GT(solution->ledger.unsent.r, 0);
}

TEST(Stop, CancelledLaterKeepsTheFinishedPassesOnly) {
  SolverRun run(Cornell(), Budget(Method::kPmcr, 100000));
  ASSERT_TRUE(run.Pass().ok());
  const std::string finished = run.SolutionBytes();
  CancellingExecutor executor(run.executor, 2);
  EXPECT_EQ(run.solver.RunPass(executor, nullptr).code(), absl::StatusCode::kCancelled);
  EXPECT_TRUE(run.SolutionBytes() == finished);
}

TEST(StopReasonName, IsTheNameOfEachReason) {
  EXPECT_STREQ(StopReasonName(StopReason::kNone), "none");
  EXPECT_STREQ(StopReasonName(StopReason::kErrorReached), "error_reached");
  EXPECT_STREQ(StopReasonName(StopReason::kRaysSpent), "rays_spent");
  EXPECT_STREQ(StopReasonName(StopReason::kTimeSpent), "time_spent");
  EXPECT_STREQ(StopReasonName(StopReason::kNothingToShoot), "nothing_to_shoot");
}

}  // namespace
}  // namespace lambert

// The estimated error is the true one.
#include "tests/solve/run_solver.h"
#include "tests/support/statistics.h"

namespace lambert {
namespace {

constexpr int kSeeds = 16;

// CONTRACT's rms_area between a radiosity and its truth, by patch.
double RmsArea(const PatchSet& patches, const std::vector<Rgb>& b, const std::vector<Rgb>& truth) {
  double area = 0, reflected = 0, error = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const double a = patches.area_m2[i];
    area += a;
    reflected += a * Mean(truth[i] - patches.exitance_lm_per_m2[i]);
    error += a * std::pow(Mean(b[i] - truth[i]), 2);
  }
  return std::sqrt(error / area) / (reflected / area);
}

struct Solved {
  std::vector<std::vector<Rgb>> radiosity;  // by seed
  double estimated = 0;                     // root mean square over the seeds
};
Solved SolveSeeds(SharedPatches patches, Method method, int64_t rays) {
  Solved solved;
  double sum = 0;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    SolverRun run(patches, Budget(method, rays, seed));
    EXPECT_TRUE(run.ToTheEnd().ok());
    const Snapshot snapshot = run.solver.MakeSnapshot();
    solved.radiosity.push_back(snapshot.solution->radiosity_lm_per_m2);
    sum += std::pow(snapshot.progress.estimated_rms_area, 2);
  }
  solved.estimated = std::sqrt(sum / kSeeds);
  return solved;
}

void ExpectTrueError(SharedPatches patches, Method method, const std::vector<Rgb>& truth,
                     double truth_noise, const Solved& solved) {
  double sum = 0;
  for (const auto& b : solved.radiosity) sum += std::pow(RmsArea(*patches, b, truth), 2);
  const double ratio = solved.estimated / std::sqrt(sum / kSeeds / truth_noise);
  EXPECT_GT(ratio, 0.8) << MethodName(method);
  EXPECT_LT(ratio, 1.25) << MethodName(method);
}

TEST(EstimatedError, IsTheTrueErrorOfAFurnace) {
  const SharedPatches patches = Share(MakeFurnace(0.6, 1, 4));
  const std::vector<Rgb> truth(patches->size(), Rgb{2.5, 2.5, 2.5});  // E / (1 - rho)
  for (Method method : ShootingMethods()) {
    ExpectTrueError(patches, method, truth, 1, SolveSeeds(patches, method, 40000));
  }
}

// The mean over the seeds stands for the truth; distances from it are (n - 1) / n of the variance.
TEST(EstimatedError, IsTheSpreadOverSeedsOfACornellBox) {
  const SharedPatches patches = Share(MakeCornell(2));
  for (Method method : ShootingMethods()) {
    const Solved solved = SolveSeeds(patches, method, 40000);
    std::vector<Rgb> mean(patches->size());
    for (const auto& b : solved.radiosity) {
      for (size_t i = 0; i < mean.size(); ++i) mean[i] = mean[i] + b[i] / kSeeds;
    }
    ExpectTrueError(patches, method, mean, (kSeeds - 1.0) / kSeeds, solved);
  }
}

// Whether E / (1 - rho) lies within the standard errors that a run itself states. The patches of a
// pass share their roulette, which conserves flux in a closed scene: their errors sum to almost 0.
TEST(EstimatedError, StandardErrorsOfPatchesCoverTheTruthOfAFurnace) {
  const SharedPatches patches = Share(MakeFurnace(0.6, 1, 2));
  for (Method method : {Method::kPmcr, Method::kPhs}) {
    double z2 = 0;
    int count = 0;
    for (uint64_t seed = 1; seed <= kSeeds / 2; ++seed) {
      SolverRun run(patches, Budget(method, 100000, seed));
      ASSERT_TRUE(run.ToTheEnd().ok());
      const Snapshot snapshot = run.solver.MakeSnapshot();
      ASSERT_GE(snapshot.progress.pass, 5);
      for (PatchIndex i = 0; i < patches->size(); ++i, ++count) {
        z2 += std::pow((snapshot.solution->radiosity_lm_per_m2[i].g - 2.5) /
                           snapshot.solution->std_error_lm_per_m2[i].g,
                       2);
      }
    }
    // P passes: Student's t with P - 1 degrees of freedom has variance (P - 1) / (P - 3), 2 for the
    // 5 passes that there are at least.
    EXPECT_GT(z2 / count, MeanZ2Limits(count).low) << MethodName(method);
    EXPECT_LT(z2 / count, 2 * MeanZ2Limits(count).high) << MethodName(method);
  }
}

}  // namespace
}  // namespace lambert

// What the plan leaves out changes no answer: not a byte where it is the same work, and nothing
// beyond its standard error where the rays go elsewhere.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/solve/run_solver.h"

namespace lambert {
namespace {

// A gray room with a lamp, a black box and a fine box: 344 patches.
SharedPatches GrayRoom() {
  const Paint gray{{0.6, 0.6, 0.6}, {}}, black{{}, {}}, two_sided{{0.6, 0.6, 0.6}, {}, true};
  const Paint lamp{{0.5, 0.5, 0.5}, {7, 7, 7}};
  return Share(SceneMaker()
                   .Box({}, {3, 3, 3}, true, {gray}, 2)
                   .Quad({1, 2.9, 1}, {1, 0, 0}, {0, 0, 1}, lamp)
                   .Box({0.5, 0.1, 0.5}, {1, 1, 1}, false, {black}, 2)
                   .Box({1.5, 0.1, 1.5}, {2, 1, 2}, false, {two_sided}, 5)
                   .Light({0.2, 0.2, 2.8}, {0.3, 0.3, 0.3})
                   .Make());
}

SolveOptions With(SolveOptions options, Part part) {
  options.shoot.parts.with.Add(part);
  return options;
}
SolveOptions Without(SolveOptions options, Part part) {
  options.shoot.parts.without.Add(part);
  return options;
}

std::string Bytes(const SharedPatches& patches, const SolveOptions& options) {
  EXPECT_TRUE(ValidateFor(*patches, options).ok()) << ValidateFor(*patches, options);
  SolverRun run(patches, options);
  EXPECT_TRUE(run.ToTheEnd().ok());
  return run.SolutionBytes();
}

TEST(PartColor, OneChannelOfAGraySceneIsEachOfThree) {
  const SharedPatches room = GrayRoom();
  for (Method method : AllMethods()) {
    const SolveOptions options = Budget(method, 30'000);
    const Plan plan = MakePlan(*room, options);
    EXPECT_TRUE(plan.options.shoot.parts.without.Has(Part::kColor));
    EXPECT_TRUE(Bytes(room, With(options, Part::kColor)) == Bytes(room, options))
        << MethodName(method);
  }
}

TEST(PartColor, IsNeededWhereAPatchOrALightHasAColor) {
  PatchSet patch = *GrayRoom(), lamp = patch, light = patch;
  patch.reflectance[3].g = 0.7;
  lamp.exitance_lm_per_m2[3] = {1, 1, 1.5};
  light.lights[0].strength.b = 0;
  EXPECT_TRUE(ValidateFor(*GrayRoom(), Without({}, Part::kColor)).ok());
  for (const PatchSet& colored : {patch, lamp, light}) {
    EXPECT_TRUE(MakePlan(colored, {}).options.shoot.parts.with.Has(Part::kColor));
    const absl::Status refused = ValidateFor(colored, Without({}, Part::kColor));
    EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument);
    EXPECT_NE(refused.message().find("not gray"), std::string::npos) << refused;
  }
}

TEST(PartClusters, CountTheSameWithoutThem) {
  const SharedPatches room = GrayRoom();
  for (Method method : {Method::kPhs, Method::kPhsAdaptive, Method::kPhsHier}) {
    const SolveOptions options = Budget(method, 30'000);
    EXPECT_TRUE(Bytes(room, With(options, Part::kClusters)) ==
                Bytes(room, Without(options, Part::kClusters)))
        << MethodName(method);
  }
}

TEST(PartVisibility, OfAConvexRoomIsNothingThatExactHasToTrace) {
  const auto room = Share(SceneMaker()
                              .Box({}, {3, 2, 3}, true, {{{0.6, 0.5, 0.4}, {1, 2, 3}}}, 3)
                              .Light({1, 1.5, 1}, {1, 1, 1})
                              .Make());
  const SolveOptions options = Budget(Method::kExact, 100'000);
  EXPECT_TRUE(MakePlan(*room, options).options.shoot.parts.without.Has(Part::kVisibility));
  SolverRun with(room, With(options, Part::kVisibility)), without(room, options);
  ASSERT_TRUE(with.ToTheEnd().ok());
  ASSERT_TRUE(without.ToTheEnd().ok());
  const Solution a = *with.solver.MakeSnapshot().solution;
  const Solution b = *without.solver.MakeSnapshot().solution;
  for (PatchIndex i = 0; i < room->size(); ++i) {
    // Point lights are sampled where something may hide them.
    const double error = 4 * Mean(a.std_error_lm_per_m2[i]) + 1e-9;
    EXPECT_NEAR(Mean(a.radiosity_lm_per_m2[i]), Mean(b.radiosity_lm_per_m2[i]), error) << i;
  }
}

TEST(PartHierarchy, OfSurfacesOfOnePatchIsNothing) {
  PatchSet loose = *GrayRoom();
  for (PatchIndex i = 0; i < loose.size(); ++i) loose.source[i].node = i;
  const auto patches = std::make_shared<const PatchSet>(loose);
  const SolveOptions options = Budget(Method::kPhsHier, 30'000);
  EXPECT_TRUE(Bytes(patches, With(options, Part::kHierarchy)) == Bytes(patches, options));
}

TEST(PartStdError, WithoutItABudgetIsOnePassAfterAPilotAndNoErrorIsTold) {
  const SharedPatches room = GrayRoom();
  for (Method method : {Method::kMcr, Method::kPmcr, Method::kPhs}) {
    const SolveOptions options = Without(Budget(method, 200'000), Part::kStdError);
    EXPECT_TRUE(ValidateFor(*room, options).ok());
    SolverRun run(room, options);
    ASSERT_TRUE(run.ToTheEnd().ok());
    const Snapshot snapshot = run.solver.MakeSnapshot();
    EXPECT_EQ(snapshot.progress.pass, 2) << MethodName(method);
    EXPECT_NEAR(static_cast<double>(snapshot.progress.rays), 200'000, 8'000) << MethodName(method);
    EXPECT_EQ(run.solver.stop_reason(), StopReason::kRaysSpent);
    EXPECT_EQ(snapshot.progress.estimated_rms_area, -1);
    for (const Rgb& error : snapshot.solution->std_error_lm_per_m2) {
      EXPECT_EQ(error, kUnknownError);
    }
  }
}

TEST(PartStdError, IsNeededWhereAWantedErrorOrABudgetOfTimeIsJudgedByIt) {
  const SharedPatches room = GrayRoom();
  SolveOptions error = Budget(Method::kPmcr, 1000), time = error;
  error.max_error = 0.1;
  time.max_rays = 0;
  time.max_time_s = 1;
  for (const SolveOptions& options : {SolveOptions{}, error, time}) {
    const absl::Status refused = ValidateFor(*room, Without(options, Part::kStdError));
    EXPECT_NE(refused.message().find("--without std-error"), std::string::npos) << refused;
  }
}

// Irradiance of all patches and of the black ones, over 8 seeds.
struct Estimates {
  double mean[2] = {}, squared_error[2] = {};
};
Estimates Over8Seeds(const SharedPatches& patches, SolveOptions options) {
  Estimates estimates;
  double values[2][8] = {};
  for (int k = 0; k < 8; ++k) {
    options.seed = 100 + static_cast<uint64_t>(k);
    SolverRun run(patches, options);
    EXPECT_TRUE(run.ToTheEnd().ok());
    const Solution solution = *run.solver.MakeSnapshot().solution;
    for (PatchIndex i = 0; i < patches->size(); ++i) {
      const double flux = Mean(solution.irradiance_lx[i]) * patches->area_m2[i];
      values[0][k] += flux;
      if (patches->reflectance[i] == Rgb{}) values[1][k] += flux;
    }
  }
  for (int v = 0; v < 2; ++v) {
    double sum = 0, squares = 0;
    for (double value : values[v]) sum += value;
    for (double value : values[v]) squares += (value - sum / 8) * (value - sum / 8);
    estimates.mean[v] = sum / 8;
    estimates.squared_error[v] = squares / (8 * 7);
  }
  return estimates;
}

struct PartCase {
  Part part;
  Method method;
};
class RaysElsewhere : public testing::TestWithParam<PartCase> {};

TEST_P(RaysElsewhere, ChangeNothingBeyondTheirStandardError) {
  const auto& [part, method] = GetParam();
  const SharedPatches room = GrayRoom();
  const SolveOptions options = Budget(method, 40'000);
  const Estimates a = Over8Seeds(room, With(options, part));
  const Estimates b = Over8Seeds(room, Without(options, part));
  for (int v = 0; v < 2; ++v) {
    // 4 standard errors of a difference of means of 8: Student's t with 14 degrees of freedom is
    // beyond in one of 800.
    const double error = std::sqrt(a.squared_error[v] + b.squared_error[v]);
    EXPECT_LT(std::fabs(a.mean[v] - b.mean[v]), 4 * error) << "value " << v;
    EXPECT_LT(error, 0.03 * a.mean[v]);
  }
}

INSTANTIATE_TEST_SUITE_P(Parts, RaysElsewhere,
                         testing::Values(PartCase{Part::kPyramids, Method::kPhs},
                                         PartCase{Part::kPyramids, Method::kPhsHier},
                                         PartCase{Part::kDimDensities, Method::kPhs},
                                         PartCase{Part::kBlack, Method::kPhs},
                                         PartCase{Part::kUnlit, Method::kPhs},
                                         PartCase{Part::kAlpha, Method::kPhsAlpha},
                                         PartCase{Part::kHierarchy, Method::kPhsHier},
                                         PartCase{Part::kStdError, Method::kPmcr},
                                         PartCase{Part::kAmbient, Method::kPmcr}));

}  // namespace
}  // namespace lambert

// The stiff and extreme scenes beside the project, each held to the answer of its manifest: skipped
// where they are not there. Answers that name single surfaces ("values") have tests of their own in
// squares_test.cc, cie171_test.cc and stiff_test.cc; here they must solve and balance.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/analytic/seeds.h"

namespace lambert {
namespace {

using Json = nlohmann::json;
constexpr const char* kFolder = "../shared/scenes/stiff/";
constexpr int kCorpusSeeds = 8;
constexpr int64_t kRays = 50000;

std::string ReadFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

PatchSet Load(const std::string& name) {
  const auto scene = LoadGltf({name, ReadFile(kFolder + name), {}});
  EXPECT_TRUE(scene.ok()) << name << ": " << scene.status();
  auto patches = BuildPatches(*scene, {});
  EXPECT_TRUE(patches.ok()) << name << ": " << patches.status();
  return *std::move(patches);
}

double Power(const PatchSet& patches, const Solution& solution, int channel) {
  double power = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    power += patches.area_m2[i] * solution.radiosity_lm_per_m2[i][channel];
  }
  return power;
}

// Within four standard errors over eight seeds or else, as a hundred cases do not all come out by
// chance, over 64 others. What the manifest allows is for areas that float32 rounds.
void ExpectPower(const PatchSet& patches, Method method, const std::vector<Solution>& solutions,
                 int channel, double truth, double allowed) {
  const auto power = [&](const Solution& s) { return Power(patches, s, channel); };
  const auto limit = [&](const Estimate& e) { return 4 * e.std_error + (allowed + 1e-6) * truth; };
  Estimate found = Over(solutions, power);
  if (std::abs(found.mean - truth) > limit(found)) {
    found = Over(SolveSeeds(patches, WithRays(method, kRays), 64, 1000), power);
  }
  EXPECT_NEAR(found.mean, truth, limit(found));
}

// Every patch that rays have hit often enough is as bright as the closed form says, by its own
// standard errors.
void ExpectUniform(const PatchSet& patches, Method method, const std::vector<Solution>& solutions,
                   int channel, double ratio) {
  double z2 = 0;
  int count = 0;
  double power = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const double truth = ratio * patches.exitance_lm_per_m2[i][channel];
    power += truth * patches.area_m2[i];
    int64_t hits = 0;
    for (const Solution& s : solutions) hits += s.hits[i];
    if (hits < 400) continue;
    const Estimate b =
        Over(solutions, [&](const Solution& s) { return s.radiosity_lm_per_m2[i][channel]; });
    if (!(b.std_error > 0)) continue;
    z2 += std::pow((b.mean - truth) / b.std_error, 2);
    ++count;
  }
  ExpectPower(patches, method, solutions, channel, power, 0);
  // Student's t with 7 degrees of freedom has variance 7/5 and z^2 a fourth moment that spreads the
  // mean of a few patches widely.
  if (count > 0) {
    EXPECT_LT(z2 / count, 1.4 * (1 + 6 / std::sqrt(count)));
  }
}

void ExpectSound(const std::vector<Solution>& solutions) {
  for (const Solution& s : solutions) {
    for (size_t i = 0; i < s.hits.size(); ++i) {
      ASSERT_TRUE(IsFinite(s.radiosity_lm_per_m2[i]) && IsFinite(s.std_error_lm_per_m2[i]));
    }
    const Ledger& l = s.ledger;
    for (int c = 0; c < 3; ++c) {
      const double sum = l.absorbed[c] + l.escaped[c] + l.unsent[c] + l.residual[c];
      // Relative to all flux that was shot, which in stiff scenes is up to 1e6 times the emission.
      EXPECT_NEAR(sum, l.emitted[c], 1e-9 * l.emitted[c]);
    }
  }
}

void Check(const Json& scene, Method method) {
  const PatchSet patches = Load(scene["file"]);
  if (scene["expect"] == "diagnostic") {
    auto shared = std::make_shared<const PatchSet>(patches);
    SerialExecutor executor(*Shooter::Create(shared, {}));
    Solver solver(shared, MakePlan(patches, WithRays(method, kRays)).options, [] { return 0.0; });
    absl::Status status;
    while (status.ok() && solver.stop_reason() == StopReason::kNone) {
      status = solver.RunPass(executor, nullptr);
    }
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(GetErrorDetail(status)->reason, scene["diagnostic"]);
    return;
  }
  const std::vector<Solution> solutions =
      SolveSeeds(patches, WithRays(method, kRays), kCorpusSeeds, 40);
  ASSERT_EQ(solutions.size(), static_cast<size_t>(kCorpusSeeds));
  ExpectSound(solutions);
  const std::string check = scene["check"];
  const Rgb emitted = EmittedFlux(patches);
  if (check == "uniform") {
    for (int c = 0; c < 3; ++c) ExpectUniform(patches, method, solutions, c, scene["B_over_E"]);
  } else if (check == "uniform_rgb") {
    for (int c = 0; c < 3; ++c) {
      double area = 0;
      for (double a : patches.area_m2) area += a;
      const double b_over_pi_l = scene["B_over_piL"][c];
      ExpectPower(patches, method, solutions, c, b_over_pi_l * std::numbers::pi * area, 0);
    }
  } else if (check == "balance") {
    const double allowed = scene.contains("tol") ? std::stod(std::string(scene["tol"])) : 0.0;
    const double truth = scene.contains("sum_A_B_over_piL")
                             ? std::numbers::pi * static_cast<double>(scene["sum_A_B_over_piL"])
                             : emitted.r / (1 - static_cast<double>(scene["rho"]));
    for (int c = 0; c < 3; ++c) ExpectPower(patches, method, solutions, c, truth, allowed);
  } else if (check == "all_zero") {
    for (const Rgb& b : solutions[0].radiosity_lm_per_m2) EXPECT_EQ(b, Rgb{});
  } else {
    for (const Solution& s : solutions) EXPECT_LE(s.ledger.absorbed.r, emitted.r * 1.1);
  }
}

TEST(StiffCorpus, EverySceneHasTheAnswerOfItsManifest) {
  const std::string manifest = ReadFile(std::string(kFolder) + "MANIFEST.json");
  if (manifest.empty()) GTEST_SKIP() << kFolder << " is not here";
  const Json cases = Json::parse(manifest)["cases"];
  ASSERT_GT(cases.size(), 50u);
  for (const Json& scene : cases) {
    for (Method method : {Method::kPmcr, Method::kPhs}) {
      SCOPED_TRACE(std::string(scene["file"]) + ", " + MethodName(method));
      Check(scene, method);
    }
  }
}

}  // namespace
}  // namespace lambert

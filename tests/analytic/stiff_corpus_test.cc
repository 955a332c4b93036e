// The stiff and extreme scenes beside the project, each held to all that its manifest states, by
// pmcr and phs: skipped where they are not there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/solve/plan.h"
#include "radiosity/solve/solver.h"
#include "tests/analytic/stiff_case.h"
#include "tests/support/read_file.h"

namespace lambert {
namespace {

using Json = nlohmann::json;
constexpr const char* kFolder = "../shared/scenes/stiff/";

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

// The patches that the manifest calls `surface`: by material, by side, or right of the partition.
std::vector<PatchIndex> Surface(const StiffCase& c, const std::string& surface) {
  const auto material = [&](PatchIndex i) {
    const PatchSource& source = c.patches.source[i];
    const Primitive& primitive = c.scene.meshes[source.mesh].primitives[source.primitive];
    return c.scene.materials[primitive.material].name;
  };
  const auto is_right_half = [&](PatchIndex i) {
    for (const Vec3& p : c.patches.corners[i]) {
      if ((c.patches.origin + p).x < 1) return false;
    }
    return material(i) != "partition" || PatchNormal(c.patches, i).x > 0;
  };
  std::vector<PatchIndex> found;
  for (PatchIndex i = 0; i < c.patches.size(); ++i) {
    if (surface == "right_half"                   ? is_right_half(i)
        : surface == "front" || surface == "back" ? c.patches.is_back[i] == (surface == "back")
        : surface == "walls"                      ? material(i) == "wall"
        : surface == "shell"                      ? material(i) == "inner_shell_out"
                                                  : material(i) == surface) {
      found.push_back(i);
    }
  }
  EXPECT_FALSE(found.empty()) << surface;
  return found;
}

double GreatestExitance(const PatchSet& patches, const std::vector<PatchIndex>& of) {
  double greatest = 0;
  for (PatchIndex i : of) greatest = std::max(greatest, patches.exitance_lm_per_m2[i].r);
  return greatest;
}

// No ray has hit it: its standard error holds the answer, and the exact method has it.
void ExpectTooSmallToHit(const StiffCase& c, PatchIndex tiny, double truth, double allowed) {
  for (const Solution& s : c.solutions) {
    EXPECT_EQ(s.hits[tiny], 0);
    EXPECT_EQ(s.radiosity_lm_per_m2[tiny].r, 0);
    EXPECT_GE(s.std_error_lm_per_m2[tiny].r, truth);
  }
  const Solution exact = SolveSeeds(c.patches, WithRays(Method::kExact, 1000), 1).at(0);
  EXPECT_NEAR(exact.radiosity_lm_per_m2[tiny].r, truth, allowed * truth);
}

// One entry of "values".
void ExpectNamedValue(const StiffCase& c, const std::string& name, double truth) {
  SCOPED_TRACE(name);
  if (name == "sum_A_B") return ExpectPower(c, 0, truth);
  const double direct_lx = 10000.0 / 96;  // CIE 171: all of the lamp's light on all walls
  if (name == "mean_total_illuminance_lx" || name == "mean_indirect_illuminance_lx") {
    const double less = name == "mean_total_illuminance_lx" ? 0 : direct_lx;
    return ExpectValue(
        c, [&](const Solution& s) { return AreaMean(c.patches, s.irradiance_lx) - less; }, truth,
        1e-6 * truth);
  }
  // B_SURFACE, in units of the lamp's exitance E, of its own pi L, or none where it is dark.
  ASSERT_EQ(name.substr(0, 2), "B_");
  const std::vector<PatchIndex> surface = Surface(c, name.substr(2, name.find("_over_") - 2));
  std::vector<PatchIndex> all(c.patches.size());
  std::iota(all.begin(), all.end(), 0);
  const bool own = name.find("_over_piL") != std::string::npos;
  const double exitance = GreatestExitance(c.patches, own ? surface : all);
  if (name == "B_tiny_over_E") {
    for (PatchIndex tiny : surface) ExpectTooSmallToHit(c, tiny, truth * exitance, 1e-3);
    return;
  }
  ExpectRadiosity(c, surface, exitance, truth);
}

// In the order of the file.
void ExpectTriangleValues(const StiffCase& c, const std::vector<double>& truths) {
  std::vector<PatchIndex> order(c.patches.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](PatchIndex i, PatchIndex j) {
    const PatchSource &a = c.patches.source[i], &b = c.patches.source[j];
    return std::pair(a.primitive, a.triangle) < std::pair(b.primitive, b.triangle);
  });
  ASSERT_EQ(order.size(), truths.size());
  for (size_t k = 0; k < truths.size(); ++k) {
    ExpectRadiosity(c, {order[k]}, GreatestExitance(c.patches, order), truths[k]);
  }
}

// What the notes of cases state that have bounds for an answer.
void ExpectBounds(const StiffCase& c, const std::string& file) {
  const Estimate absorbed =
      Over(c.solutions, [](const Solution& s) { return s.ledger.absorbed.r; });
  EXPECT_LE(absorbed.mean, EmittedFlux(c.patches).r + 4 * absorbed.std_error);
  if (file.starts_with("s64")) {
    // The lamp below the ceiling is there and shines down: the ceiling gets reflected light alone.
    EXPECT_NEAR(EmittedFlux(c.patches).r, 0.4 * std::numbers::pi, 1e-5);
    for (const Solution& s : c.solutions) {
      double up = 0, down = 0;
      for (PatchIndex i = 0; i < c.patches.size(); ++i) {
        if (c.patches.exitance_lm_per_m2[i].r > 0) continue;
        const double y = PatchNormal(c.patches, i).y;
        (y > 0.5 ? up : down) += std::abs(y) > 0.5 ? s.irradiance_lx[i].r : 0;
      }
      EXPECT_LT(down, 0.6 * up);
      EXPECT_EQ(s.ledger.escaped.r, 0);
    }
  } else if (file.starts_with("s66")) {
    // Half of the light's flux comes into the room, of which rho = .5 makes as much power.
    ExpectPower(c, 0, 2 * std::numbers::pi);
  }
}

void ExpectRefused(const PatchSet& patches, const SolveOptions& options,
                   const std::string& reason) {
  auto shared = std::make_shared<const PatchSet>(patches);
  const SolveOptions planned = MakePlan(patches, options).options;
  SerialExecutor executor(*Shooter::Create(shared, planned.shoot));
  Solver solver(shared, planned, [] { return 0.0; });
  absl::Status status;
  while (status.ok() && solver.stop_reason() == StopReason::kNone) {
    status = solver.RunPass(executor, nullptr);
  }
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(ReasonOf(status), reason);
}

void ExpectWarned(const PatchSet& patches, const std::string& reason) {
  EXPECT_TRUE(std::any_of(patches.warnings.begin(), patches.warnings.end(),
                          [&](const Warning& warning) { return warning.reason == reason; }))
      << reason;
}

void ExpectAnswer(const StiffCase& c) {
  const std::string check = c.stated["check"];
  if (check == "uniform") {
    for (int k = 0; k < 3; ++k) ExpectUniform(c, k, c.stated["B_over_E"]);
  } else if (check == "uniform_rgb") {
    const double area = std::accumulate(c.patches.area_m2.begin(), c.patches.area_m2.end(), 0.0);
    for (int k = 0; k < 3; ++k) {
      ExpectPower(c, k, double{c.stated["B_over_piL"][k]} * std::numbers::pi * area);
    }
  } else if (check == "balance") {
    const double allowed = std::stod(c.stated.value("tol", "0"));
    const double truth = c.stated.contains("sum_A_B_over_piL")
                             ? std::numbers::pi * double{c.stated["sum_A_B_over_piL"]}
                             : EmittedFlux(c.patches).r / (1 - double{c.stated["rho"]});
    for (int k = 0; k < 3; ++k) ExpectPower(c, k, truth, allowed);
  } else if (check == "all_zero") {
    for (const Rgb& b : c.solutions[0].radiosity_lm_per_m2) EXPECT_EQ(b, Rgb{});
  } else if (check == "bounds") {
    ExpectBounds(c, c.stated["file"]);
  } else {
    // Where triangles have values of their own, "values" are those of undivided squares.
    if (c.stated.contains("triangle_values_over_E")) {
      return ExpectTriangleValues(c, c.stated["triangle_values_over_E"]);
    }
    for (const auto& [name, truth] : c.stated["values"].items()) ExpectNamedValue(c, name, truth);
  }
}

void Check(const Json& stated, Method method) {
  const std::string name = stated["file"];
  StiffCase c{stated, {}, {}, WithRays(method, kStiffRays), {}};
  const auto scene = LoadGltf({name, ReadFile(kFolder + name), {}});
  ASSERT_TRUE(scene.ok()) << scene.status();
  c.scene = *scene;
  // The floor of s48 reaches under its partition, and is to be cut there.
  const auto patches = BuildPatches(*scene, {.max_edge_m = name.starts_with("s48") ? 1.2 : 0});
  ASSERT_TRUE(patches.ok()) << patches.status();
  c.patches = *patches;
  if (stated["expect"] == "diagnostic")
    return ExpectRefused(*patches, c.options, stated["diagnostic"]);
  if (stated.contains("diagnostic")) ExpectWarned(*patches, stated["diagnostic"]);
  c.solutions = SolveSeeds(c.patches, c.options, kStiffSeeds, 40);
  ASSERT_EQ(c.solutions.size(), static_cast<size_t>(kStiffSeeds));
  ExpectSound(c.solutions);
  ExpectAnswer(c);
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

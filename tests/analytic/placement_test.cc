// Radiosity does not depend on where a scene is, how it is turned and how large it is: scenes with
// closed-form answers, turned at random, from 1e-15 to 1e12 m large and up to a thousand times
// their size away.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "tests/analytic/seeds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr int kPlacements = 8;

// Turned by a random rotation, scaled by 1e-15 to 1e12, then moved.
Transform RandomPlacement(std::mt19937* random, double most_sizes_away) {
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> exponent(-15, 12), sizes(0, most_sizes_away);
  const auto vector = [&] { return Vec3{gauss(*random), gauss(*random), gauss(*random)}; };
  const double scale = std::pow(10, exponent(*random));
  const Vec3 z = Normalized(vector()), x = Normalized(Cross(z, vector()));
  return {x * scale, Cross(z, x) * scale, z * scale,
          Normalized(vector()) * (scale * sizes(*random))};
}

// Placed by the transforms of its nodes.
Scene PlacedByNodes(Scene scene, const Transform& placement) {
  for (Instance& instance : scene.instances) instance.world = placement;
  return scene;
}

// Placed in its vertices, which are rounded to float32 there.
Scene PlacedInVertices(Scene scene, const Transform& placement) {
  for (Mesh& mesh : scene.meshes) {
    for (Primitive& primitive : mesh.primitives) {
      for (auto& p : primitive.positions) p = ToFloats(placement.Point(FromFloats(p)));
    }
  }
  return scene;
}

// Area-weighted mean radiosity of one primitive of a node, red channel; -1: of all of them.
double MeanOf(const PatchSet& patches, const Solution& solution, int32_t node, int32_t primitive) {
  double power = 0, area = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const PatchSource& source = patches.source[i];
    if (source.node != node || (primitive >= 0 && source.primitive != primitive)) continue;
    power += patches.area_m2[i] * solution.radiosity_lm_per_m2[i].r;
    area += patches.area_m2[i];
  }
  return power / area;
}

struct Answer {
  const char* what;
  int32_t node, primitive;  // see MeanOf
  double radiosity;
};
struct ClosedForm {
  const char* name;
  Scene scene;
  std::vector<Answer> answers;
};

Scene TwoRooms() {
  const Paint lit{{0.5, 0.5, 0.5}, {1, 1, 1}}, dark{{0.5, 0.5, 0.5}, {}};
  return SceneMaker()
      .Box({0, 0, 0}, {1, 1, 1}, true, {lit}, 2)
      .Box({1, 0, 0}, {2, 1, 1}, true, {dark}, 2)
      .Make();
}

std::vector<ClosedForm> ClosedForms() {
  std::vector<Rgb> ceiling(6);
  ceiling[3] = {1, 1, 1};
  return {
      {"furnace", MakeFurnace(0.8, 1, 2), {{"walls", 0, -1, 5}}},
      {"parallel squares",
       MakeParallelSquares(0.5, 0.5),
       {{"a", 0, -1, 1.010083152275}, {"b", 1, -1, 0.1009198802750}}},
      {"perpendicular squares",
       MakePerpendicularSquares(0.8, 0.3),
       {{"a", 0, -1, 0.5 * (1.006110930627 + 1.015568282603)},
        {"b", 1, -1, 0.5 * (0.08138899632311 + 0.04013015480378)}}},
      {"two rooms", TwoRooms(), {{"lit", 0, -1, 2}, {"dark", 1, -1, 0}}},
      {"cube", MakeBox(1, {0.5, 0.5, 0.5}, ceiling), {{"floor", 0, 2, 0.1777485977549}}},
  };
}

void ExpectAnswers(const PatchSet& patches, Method method, const std::vector<Answer>& answers) {
  std::vector<Truth> truths;
  for (const Answer& a : answers) {
    const auto mean = [&patches, a](const Solution& s) {
      return MeanOf(patches, s, a.node, a.primitive);
    };
    if (a.radiosity > 0) {
      truths.push_back({a.what, a.radiosity, mean});
      continue;
    }
    for (const Solution& s : SolveSeeds(patches, WithRays(method, 100000), 2)) {
      EXPECT_EQ(mean(s), 0) << "a leak";
    }
  }
  ExpectTruths(patches, WithRays(method, 40000), truths);
}

// Each closed form by several placements up to `most_sizes_away`.
void ForEachPlacement(int seed, double most_sizes_away,
                      const std::function<void(const ClosedForm&, const Transform&)>& check) {
  std::mt19937 random(seed);
  for (const ClosedForm& form : ClosedForms()) {
    for (int k = 0; k < kPlacements; ++k) {
      SCOPED_TRACE(testing::Message() << form.name << ", placement " << k);
      check(form, RandomPlacement(&random, most_sizes_away));
    }
  }
}

class Placement : public testing::TestWithParam<Method> {};

TEST_P(Placement, ByNodesChangesNoRadiosity) {
  ForEachPlacement(1, 1000, [](const ClosedForm& form, const Transform& placement) {
    ExpectAnswers(PatchesOf(PlacedByNodes(form.scene, placement)), GetParam(), form.answers);
  });
}

// Rounding moves vertices by up to 1e-7 of the scene's size and distance: answers by hardly more.
TEST_P(Placement, InVerticesChangesNoRadiosity) {
  ForEachPlacement(2, 3, [](const ClosedForm& form, const Transform& placement) {
    ExpectAnswers(PatchesOf(PlacedInVertices(form.scene, placement)), GetParam(), form.answers);
  });
}

INSTANTIATE_TEST_SUITE_P(All, Placement, testing::Values(Method::kPmcr, Method::kPhs),
                         [](const auto& info) { return std::string(MethodName(info.param)); });

// Digits are those of corners in double precision, relative to a scene up to a thousand sizes away.
TEST(PlacementOfExact, ByNodesChangesNoRadiosity) {
  ForEachPlacement(3, 1000, [](const ClosedForm& form, const Transform& placement) {
    const PatchSet patches = PatchesOf(PlacedByNodes(form.scene, placement));
    const Solution s = SolveSeeds(patches, WithRays(Method::kExact, 1000), 1).at(0);
    for (const Answer& a : form.answers) {
      EXPECT_NEAR(MeanOf(patches, s, a.node, a.primitive), a.radiosity, 1e-10) << a.what;
    }
  });
}

}  // namespace
}  // namespace lambert

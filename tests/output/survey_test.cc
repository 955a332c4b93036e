#include "radiosity/output/survey.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr Paint kGray{{0.5, 0.5, 0.5}, {}};

// A floor of two triangles, (0 0) (0 3) (3 3) and (0 0) (3 3) (3 0) in x and z, facing up.
SceneMaker Floor() { return SceneMaker().Quad({}, {0, 0, 3}, {3, 0, 0}, kGray, 1, "floor"); }

SceneMaker WithBox(Vec3 low, Vec3 high) { return Floor().Box(low, high, false, {kGray}, 1, "box"); }

// The survey of the floor's triangle with the corner (0 3): its centre is (1 2).
PatchSurvey SurveyOf(const SceneMaker& maker) {
  const PatchSet patches = PatchesOf(maker.Make());
  const auto scene = RayScene::Create(patches);
  EXPECT_TRUE(scene.ok());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Vec3 center = patches.origin + PatchCentroid(patches, i);
    if (patches.source[i].node == 0 && center.z > center.x) {
      return Surveyor(patches, **scene).Survey(i);
    }
  }
  ADD_FAILURE() << "no floor";
  return {};
}

int Count(const PatchSurvey& survey, CornerState state) {
  return static_cast<int>(std::count(survey.corners.begin(), survey.corners.end(), state));
}

TEST(Surveyor, AnEmptyFloorIsOpen) {
  const PatchSurvey survey = SurveyOf(Floor());
  EXPECT_EQ(Count(survey, CornerState::kOpen), 3);
  EXPECT_EQ(survey.exposed_share, 1);
}

TEST(Surveyor, ATableOverTheFloorHidesNothing) {
  const PatchSurvey survey = SurveyOf(WithBox({0.5, 0.7, 0.5}, {2.5, 0.75, 2.5}));
  EXPECT_EQ(Count(survey, CornerState::kOpen), 3);
  EXPECT_EQ(survey.exposed_share, 1);
}

TEST(Surveyor, ALegOnTheCentreCutsNothingOff) {
  const PatchSurvey survey = SurveyOf(WithBox({0.95, 0, 1.95}, {1.05, 0.7, 2.05}));
  EXPECT_EQ(Count(survey, CornerState::kOpen), 3);
  EXPECT_NEAR(survey.exposed_share, 1, 0.07);
}

TEST(Surveyor, ALegUnderATableTopIsSolidToo) {
  SceneMaker maker = WithBox({0.3, 0, 1.7}, {1.3, 0.7, 2.7});
  maker.Box({0, 0.7, 1}, {2, 0.75, 3}, false, {kGray}, 1, "top");
  EXPECT_NEAR(SurveyOf(maker).exposed_share, 1 - 1 / 4.5, 0.13);
}

TEST(Surveyor, ALegOnTheWayToACornerCutsNothingOff) {
  const PatchSurvey survey = SurveyOf(WithBox({0.45, 0, 2.45}, {0.55, 0.7, 2.55}));
  EXPECT_EQ(Count(survey, CornerState::kOpen), 3);
}

TEST(Surveyor, ABoxOnACornerHidesThatCorner) {
  const PatchSurvey survey = SurveyOf(WithBox({-0.5, 0, 2.2}, {0.8, 1, 3.5}));
  EXPECT_EQ(Count(survey, CornerState::kHidden), 1);
  EXPECT_EQ(Count(survey, CornerState::kOpen), 2);
  EXPECT_NEAR(survey.exposed_share, 1 - 0.64 / 4.5, 0.07);
}

TEST(Surveyor, ABoxOnTheCentreLeavesTheCornersAroundItOpen) {
  // It covers .4 < x < z < 2.6 of the triangle 0 < x < z < 3.
  const PatchSurvey survey = SurveyOf(WithBox({0.4, 0, 0.4}, {2.6, 1, 2.6}));
  EXPECT_EQ(Count(survey, CornerState::kOpen), 3);
  EXPECT_NEAR(survey.exposed_share, 1 - 2.2 * 2.2 / 9, 0.13);
}

TEST(Surveyor, APartitionCutsOffTheCornerBehindIt) {
  // Across x = 2, or x = .5: one or two corners lie beyond.
  const Vec3 up{0, 1, 0}, along{0, 0, 5};
  const PatchSurvey one = SurveyOf(Floor().Quad({2, 0, -1}, up, along, kGray, 1, "wall"));
  EXPECT_EQ(Count(one, CornerState::kCutOff), 1);
  EXPECT_EQ(one.exposed_share, 1);
  const PatchSurvey two = SurveyOf(Floor().Quad({0.5, 0, -1}, up, along, kGray, 1, "wall"));
  EXPECT_EQ(Count(two, CornerState::kCutOff), 2);
}

TEST(Surveyor, JoinsNeighboursAcrossAFreeSideOnly) {
  for (bool wall : {false, true}) {
    SceneMaker maker = Floor();
    // A wall along the diagonal that the two triangles share.
    if (wall) maker.Quad({-1, 0, -1}, {0, 1, 0}, {5, 0, 5}, kGray, 1, "wall");
    const PatchSet patches = PatchesOf(maker.Make());
    const auto scene = RayScene::Create(patches);
    ASSERT_TRUE(scene.ok());
    const Surveyor surveyor(patches, **scene);
    std::vector<PatchIndex> floor;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      if (patches.source[i].node == 0) floor.push_back(i);
    }
    ASSERT_EQ(floor.size(), 2u);
    const PatchIndex a = floor[0], b = floor[1];
    EXPECT_TRUE(surveyor.NearlyCoplanar(a, b));
    for (int corner_a = 0; corner_a < 3; ++corner_a) {
      for (int corner_b = 0; corner_b < 3; ++corner_b) {
        if (patches.corners[a][corner_a] != patches.corners[b][corner_b]) continue;
        // The other end of the diagonal is the corner of a that b has too.
        for (int other = 0; other < 3; ++other) {
          const auto& c = patches.corners[b];
          const bool shared = std::find(c.begin(), c.end(), patches.corners[a][other]) != c.end();
          if (other == corner_a || !shared) continue;
          EXPECT_EQ(surveyor.JoinedAt(a, corner_a, other, b, corner_b), !wall);
        }
      }
    }
  }
}

}  // namespace
}  // namespace lambert

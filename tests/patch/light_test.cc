#include "radiosity/patch/light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

Light Spot(Vec3 position, Vec3 z, Rgb intensity_cd, double cos_inner, double cos_outer) {
  Light light{"spot", position, intensity_cd};
  light.z = z;
  light.cos_inner = cos_inner;
  light.cos_outer = cos_outer;
  return light;
}

TEST(SampleLight, APointLightFallsByTheSquareOfTheDistance) {
  PatchSet patches;
  patches.lights.push_back({"", {0, 3, 0}, {9, 18, 0}});
  ASSERT_EQ(LightCount(patches), 1);
  EXPECT_TRUE(IsDelta(patches, 0));
  const LightSample sample = SampleLight(patches, 0, {0, 0, 0}, 0.3, 0.7);
  EXPECT_EQ(sample.direction, (Vec3{0, 1, 0}));
  EXPECT_EQ(sample.distance_m, 3);
  EXPECT_EQ(sample.illuminance_lx, (Rgb{1, 2, 0}));
}

TEST(SampleLight, AtItsOwnPlaceAPointLightSendsNothing) {
  PatchSet patches;
  patches.lights.push_back({"", {1, 1, 1}, {9, 9, 9}});
  EXPECT_EQ(SampleLight(patches, 0, {1, 1, 1}, 0, 0).illuminance_lx, (Rgb{}));
}

TEST(SampleLight, ASpotLightsWhatLiesInItsCone) {
  PatchSet patches;
  patches.lights.push_back(Spot({0, 2, 0}, {0, -1, 0}, {8, 8, 8}, 0.9, 0.5));
  EXPECT_EQ(SampleLight(patches, 0, {0, 0, 0}, 0, 0).illuminance_lx.r, 2);
  EXPECT_EQ(SampleLight(patches, 0, {0, 4, 0}, 0, 0).illuminance_lx.r, 0);
  // 4/5 of the way to the axis: a cosine of .8, three quarters of the rim.
  const Vec3 aside{1.5, 0, 0};
  EXPECT_NEAR(SampleLight(patches, 0, aside, 0, 0).illuminance_lx.r, 8 * 0.5625 / 6.25, 1e-12);
}

TEST(SampleLight, ADistantLightIsTheSameEverywhere) {
  PatchSet patches;
  Light sun{"sun", {}, {100, 90, 80}, Light::Kind::kDistant};
  sun.z = {0.6, -0.8, 0};
  patches.lights.push_back(sun);
  for (Vec3 point : {Vec3{}, Vec3{5, -3, 100}}) {
    const LightSample sample = SampleLight(patches, 0, point, 0.2, 0.9);
    EXPECT_EQ(sample.direction, (Vec3{-0.6, 0.8, 0}));
    EXPECT_EQ(sample.distance_m, std::numeric_limits<double>::infinity());
    EXPECT_EQ(sample.illuminance_lx, (Rgb{100, 90, 80}));
  }
}

TEST(LightFlux, IsIntensityTimesSolidAngleOrIlluminanceTimesProjectedArea) {
  PatchSet patches = PatchesOf(SceneMaker().Box({}, {1, 2, 3}, true, {{}}).Make());
  patches.lights.push_back({"", {}, {1, 2, 0}});
  patches.lights.push_back(Spot({}, {1, 0, 0}, {1, 0, 0}, 0.75, 0.25));
  Light sun{"", {}, {10, 0, 0}, Light::Kind::kDistant};
  sun.z = {0.6, -0.8, 0};
  patches.lights.push_back(sun);
  const std::vector<Rgb> flux_lm = LightFlux(patches);
  ASSERT_EQ(flux_lm.size(), 3u);
  EXPECT_DOUBLE_EQ(flux_lm[0].g, 8 * kPi);
  EXPECT_DOUBLE_EQ(flux_lm[1].r, 2 * kPi * (0.25 + 0.5 / 3));
  EXPECT_DOUBLE_EQ(flux_lm[2].r, 10 * (6 * 0.6 + 3 * 0.8));
  EXPECT_EQ(LightFlux(PatchSet()).size(), 0u);
}

}  // namespace
}  // namespace lambert

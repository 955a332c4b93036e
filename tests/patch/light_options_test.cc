#include "radiosity/patch/light_options.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiosity/core/error.h"
#include "radiosity/patch/light.h"
#include "radiosity/scene/sky_map.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr double kPi = std::numbers::pi;

// A floor, node 0 "quad"; a lamp's file, a sky of 2 nit.
Scene Lit() {
  Scene scene = SceneMaker().Quad({}, {0, 0, 1}, {1, 0, 0}, {}).Light({0, 2, 0}, {9, 9, 9}).Make();
  scene.node_axes = {Transform{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {3, 4, 5}}};  // -z is -y
  scene.lights[0].node = 0;
  auto table = SphereTable::Create({true, 1, {0, 1}, {0, 1}, {50, 50, 50, 50}});
  scene.lamps["down.ies"] = {*table, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  scene.skies["two.exr"] = *DecodeSkyMap("two.exr", EncodeSkyMap({1, 1, {2, 2, 2}}));
  return scene;
}

TEST(LightsOf, SkiesHaveTheirHorizontalIlluminance) {
  const auto illuminance = [](const std::string& name, double lx) {
    const auto lights = LightsOf(Lit(), {.sky = name, .sky_illuminance_lx = lx});
    EXPECT_TRUE(lights.ok()) << lights.status();
    const Light& sky = lights->back();
    EXPECT_EQ(sky.kind, Light::Kind::kSky);
    return (sky.strength * sky.table->CosineTotal()).g;
  };
  EXPECT_NEAR(illuminance("uniform", 0), 10000, 1e-8);
  EXPECT_NEAR(illuminance("overcast", 0), 10000, 1e-8);
  EXPECT_NEAR(illuminance("overcast", 500), 500, 1e-8);
  EXPECT_NEAR(illuminance("two.exr", 0), 2 * kPi, 1e-9);
  EXPECT_NEAR(illuminance("two.exr", 70), 70, 1e-9);
}

TEST(LightsOf, TheSunStandsWhereItsAnglesSay) {
  const auto to_sun = [](double azimuth, double elevation) {
    const auto lights = LightsOf(
        Lit(),
        {.sun_azimuth_deg = azimuth, .sun_elevation_deg = elevation, .sun_illuminance_lx = 5});
    const Light& sun = lights->back();
    EXPECT_EQ(sun.kind, Light::Kind::kDistant);
    EXPECT_EQ(sun.strength, (Rgb{5, 5, 5}));
    EXPECT_NEAR(Length(Cross(sun.x, sun.y) - sun.z), 0, 1e-12);
    return -sun.z;
  };
  EXPECT_NEAR(Length(to_sun(0, 0) - Vec3{0, 0, -1}), 0, 1e-12);   // north
  EXPECT_NEAR(Length(to_sun(90, 0) - Vec3{1, 0, 0}), 0, 1e-12);   // east
  EXPECT_NEAR(Length(to_sun(180, 0) - Vec3{0, 0, 1}), 0, 1e-12);  // south
  EXPECT_NEAR(Length(to_sun(77, 90) - Vec3{0, 1, 0}), 0, 1e-12);
  EXPECT_NEAR(to_sun(45, 30).y, 0.5, 1e-12);
}

TEST(LightsOf, ALampTakesThePlaceOfTheLightAtItsNode) {
  const auto lights = LightsOf(Lit(), {.lamps = {{"down.ies", "quad"}}});
  ASSERT_TRUE(lights.ok()) << lights.status();
  ASSERT_EQ(lights->size(), 1u);
  const Light& lamp = lights->back();
  EXPECT_EQ(lamp.kind, Light::Kind::kLamp);
  EXPECT_EQ(lamp.position, (Vec3{3, 4, 5}));
  EXPECT_EQ(lamp.z, (Vec3{0, -1, 0}));
  PatchSet patches = PatchesOf(SceneMaker().Quad({}, {0, 0, 1}, {1, 0, 0}, {}).Make());
  patches.lights = {lamp};
  EXPECT_NEAR(LightFlux(patches)[0].b, 100 * kPi, 1e-9);
  EXPECT_EQ(SampleLight(patches, 0, {3, 2, 5}, 0, 0).illuminance_lx, (Rgb{12.5, 12.5, 12.5}));
  EXPECT_EQ(SampleLight(patches, 0, {3, 6, 5}, 0, 0).illuminance_lx, (Rgb{}));
}

TEST(LightsOf, WhatTheSceneLacksIsNamed) {
  for (const LightOptions& options :
       {LightOptions{.sky = "none.exr"}, LightOptions{.lamps = {{"none.ies", "quad"}}},
        LightOptions{.lamps = {{"down.ies", "none"}}}}) {
    const absl::Status status = LightsOf(Lit(), options).status();
    EXPECT_EQ(ReasonOf(status), "FIELD_INVALID");
    EXPECT_NE(status.message().find("none"), std::string::npos) << status;
  }
  Scene dark = Lit();
  dark.skies["dark.exr"] = *DecodeSkyMap("d", EncodeSkyMap({1, 2, {0, 0, 0, 1, 1, 1}}));
  EXPECT_EQ(ReasonOf(LightsOf(dark, {.sky = "dark.exr", .sky_illuminance_lx = 1}).status()),
            "FIELD_INVALID");
}

TEST(LightsOf, TooManyLargeTablesAreRefused) {
  const auto wide = [] {
    return *DecodeSkyMap("w", EncodeSkyMap({2048, 1024, std::vector<float>(3 << 21)}));
  };
  Scene scene = Lit();
  scene.skies["wide.exr"] = wide();
  scene.lights.assign(5, {"", {}, {1, 1, 1}, Light::Kind::kSky});
  for (Light& light : scene.lights) light.table = scene.skies["wide.exr"];
  EXPECT_TRUE(LightsOf(scene, {}).ok()) << "it is one table";
  scene.lights[0].table = wide();
  EXPECT_TRUE(LightsOf(scene, {.sky = "wide.exr"}).ok());
  scene.lights[1].table = wide();
  EXPECT_EQ(ReasonOf(LightsOf(scene, {}).status()), "SCENE_TOO_LARGE");
}

TEST(LightOptions, NumbersOutOfRangeAreRefused) {
  EXPECT_TRUE(LightOptions{}.Validate().ok());
  EXPECT_FALSE(LightOptions{.sky_illuminance_lx = -1}.Validate().ok());
  EXPECT_FALSE(LightOptions{.sun_illuminance_lx = std::nan("")}.Validate().ok());
  EXPECT_FALSE(LightOptions{.sun_elevation_deg = 91}.Validate().ok());
  EXPECT_FALSE(LightOptions{.sun_azimuth_deg = 1e9}.Validate().ok());
}

// A mean over numbers that fill the square: the illuminance of an open surface.
TEST(SampleLight, SamplesOfASkyMeanItsIlluminance) {
  PatchSet patches = PatchesOf(SceneMaker().Quad({}, {0, 0, 1}, {1, 0, 0}, {}).Make());
  for (const char* name : {"uniform", "overcast", "two.exr"}) {
    patches.lights = {LightsOf(Lit(), {.sky = name, .sky_illuminance_lx = 900})->back()};
    EXPECT_FALSE(IsDelta(patches, 0));
    EXPECT_TRUE(HasSky(patches));
    double sum = 0;
    constexpr int kSide = 200;
    for (int k = 0; k < kSide * kSide; ++k) {
      const LightSample s = SampleLight(patches, 0, {0.5, 0, 0.5}, (k / kSide + 0.5) / kSide,
                                        (k % kSide + 0.5) / kSide);
      EXPECT_TRUE(std::isinf(s.distance_m));
      sum += s.illuminance_lx.r * std::max(0.0, s.direction.y) / (kSide * kSide);
    }
    EXPECT_NEAR(sum, 900, 0.1) << name;
  }
}

}  // namespace
}  // namespace lambert

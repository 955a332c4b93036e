// Lights of glTF files, and those beside them.
#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/core/error.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

bool Mentions(const Scene& scene, const std::string& text) {
  for (const Warning& warning : scene.warnings) {
    if (warning.reason == "FEATURE_NOT_READ" && warning.message.find(text) != std::string::npos) {
      return true;
    }
  }
  return false;
}

TEST(LoadGltf, LightsStandWhereTheirNodesAreAndShineAlongTheirMinusZ) {
  GltfDocument document;
  document.json["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 100}, {"color", {1, 0.5, 0}}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.5}, {"outerConeAngle", 1}}}},
      {{"type", "directional"}, {"intensity", 1000}}};
  document.json["extensionsUsed"] = {"KHR_lights_punctual"};
  for (int light : {0, 1, 2}) {
    document.json["nodes"].push_back(
        {{"translation", {light, 2, 3}},
         {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},  // -z to -y
         {"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
  }
  document.json["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  ASSERT_EQ(scene->lights.size(), 3u);
  EXPECT_EQ(scene->lights[0].position, (Vec3{0, 2, 3}));
  EXPECT_EQ(scene->lights[0].strength, (Rgb{100, 50, 0}));
  EXPECT_EQ(scene->lights[0].cos_outer, -1);
  const Light& spot = scene->lights[1];
  EXPECT_EQ(spot.kind, Light::Kind::kPoint);
  EXPECT_NEAR(Length(spot.z - Vec3{0, -1, 0}), 0, 1e-12);
  EXPECT_NEAR(Length(Cross(spot.x, spot.y) - spot.z), 0, 1e-12);
  EXPECT_DOUBLE_EQ(spot.cos_inner, std::cos(0.5));
  EXPECT_DOUBLE_EQ(spot.cos_outer, std::cos(1.0));
  const Light& sun = scene->lights[2];
  EXPECT_EQ(sun.kind, Light::Kind::kDistant);
  EXPECT_NEAR(Length(sun.z - Vec3{0, -1, 0}), 0, 1e-12);
  EXPECT_EQ(sun.strength, (Rgb{1000, 1000, 1000}));
  EXPECT_TRUE(scene->warnings.empty());
}

TEST(LoadGltf, LightsThatCannotBeAreRefusedAndOnesWithoutAxesLeftOut) {
  const auto load = [](const nlohmann::json& light, double scale) {
    GltfDocument document;
    document.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
    document.json["extensionsUsed"] = {"KHR_lights_punctual"};
    document.json["nodes"].push_back({{"scale", {scale, scale, scale}},
                                      {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    document.json["scenes"][0]["nodes"] = {0, 1};
    return document.Load();
  };
  for (const auto& [inner, outer] : {std::pair{0.5, 0.4}, {-0.1, 0.5}, {0.0, 1.7}, {0.0, 0.0}}) {
    const auto refused = load(
        {{"type", "spot"}, {"spot", {{"innerConeAngle", inner}, {"outerConeAngle", outer}}}}, 1);
    EXPECT_EQ(ReasonOf(refused.status()), "SCENE_INVALID") << inner << " " << outer;
  }
  EXPECT_EQ(ReasonOf(load({{"type", "laser"}}, 1).status()), "SCENE_INVALID");
  const auto flat = load({{"type", "directional"}}, 0);
  ASSERT_TRUE(flat.ok()) << flat.status();
  EXPECT_TRUE(flat->lights.empty());
  EXPECT_TRUE(Mentions(*flat, "spot and directional lights without axes (1 node)"));
  EXPECT_EQ(load({{"type", "point"}}, 0)->lights.size(), 1u);
}

}  // namespace
}  // namespace lambert

// Lights of glTF files, and those beside them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "absl/strings/escaping.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/load_gltf.h"
#include "radiosity/scene/sky_map.h"
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

constexpr char kLamp[] =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 2 1 1 2 0 0 0\n1 1 0\n0 180\n0\n50 50\n";

// A node with lamp 0 of a list of one.
GltfDocument WithLamp(const nlohmann::json& lamp, const nlohmann::json& own) {
  GltfDocument document;
  document.json["extensions"]["EXT_lights_ies"]["lights"] = {lamp};
  document.json["extensionsUsed"] = {"EXT_lights_ies"};
  document.json["nodes"].push_back(
      {{"translation", {1, 2, 3}}, {"extensions", {{"EXT_lights_ies", own}}}});
  document.json["scenes"][0]["nodes"] = {0, 1};
  return document;
}

TEST(LoadGltf, LampsByTheirPhotometricFilesStandAtTheirNodes) {
  GltfDocument in_view = WithLamp({}, {{"light", 0}, {"multiplier", 2}, {"color", {1, 0.5, 3}}});
  in_view.json["extensions"]["EXT_lights_ies"]["lights"][0] = {
      {"bufferView", in_view.AddViewBytes(kLamp)}};
  const GltfDocument in_uri =
      WithLamp({{"uri", "data:application/x-ies-lm-63;base64," + absl::Base64Escape(kLamp)}},
               {{"light", 0}});
  for (const absl::StatusOr<Scene>& scene : {in_view.Load(), in_uri.Load()}) {
    ASSERT_TRUE(scene.ok()) << scene.status();
    ASSERT_EQ(scene->lights.size(), 1u);
    const Light& lamp = scene->lights[0];
    EXPECT_EQ(lamp.kind, Light::Kind::kLamp);
    EXPECT_EQ(lamp.position, (Vec3{1, 2, 3}));
    EXPECT_EQ(lamp.z, (Vec3{0, 0, -1}));
    EXPECT_EQ(lamp.table->Value({0, 0, 1}).r, 50);
  }
  EXPECT_EQ(in_view.Load()->lights[0].strength, (Rgb{2, 1, 2}));
  in_view.json["nodes"].push_back(in_view.json["nodes"][1]);
  in_view.json["scenes"][0]["nodes"] = {0, 1, 2};
  const absl::StatusOr<Scene> two = in_view.Load();
  ASSERT_EQ(two->lights.size(), 2u);
  EXPECT_EQ(two->lights[0].table, two->lights[1].table) << "the file is read once";
}

TEST(LoadGltf, LampsThatCannotBeReadAreRefused) {
  const auto refused = [](const nlohmann::json& lamp, const nlohmann::json& own) {
    return ReasonOf(WithLamp(lamp, own).Load().status()) == "SCENE_INVALID";
  };
  EXPECT_TRUE(refused({{"uri", "gone.ies"}}, {{"light", 0}}));
  EXPECT_TRUE(refused({{"uri", "data:,plain"}}, {{"light", 0}}));
  EXPECT_TRUE(refused({{"uri", "data:;base64,AAAA"}}, {{"light", 0}}));
  EXPECT_TRUE(refused({{"bufferView", 99}}, {{"light", 0}}));
  EXPECT_TRUE(refused({{"name", "nothing"}}, {{"light", 0}}));
  EXPECT_TRUE(refused({{"uri", "a.ies"}}, {{"light", 7}}));
  EXPECT_TRUE(refused({{"uri", "a.ies"}}, {{"light", "x"}}));
}

TEST(ListExternalFiles, NamesTheFilesOfLamps) {
  const GltfDocument document = WithLamp({{"uri", "lamps/a.ies"}}, {{"light", 0}});
  const auto files = ListExternalFiles("room.gltf", document.json.dump());
  ASSERT_TRUE(files.ok()) << files.status();
  EXPECT_NE(std::find(files->begin(), files->end(), "lamps/a.ies"), files->end());
}

TEST(LoadGltf, LampsAndSkiesBesideTheSceneAreRead) {
  const GltfDocument document;
  SceneBundle bundle{"room.gltf", document.Glb(), {}};
  bundle.files["a.IES"] = kLamp;
  bundle.files["sky.exr"] = EncodeSkyMap({1, 1, {1, 2, 3}});
  const absl::StatusOr<Scene> scene = LoadGltf(bundle);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->lamps.count("a.IES"), 1u);
  EXPECT_EQ(scene->skies.count("sky.exr"), 1u);
  EXPECT_TRUE(scene->node_axes[0].has_value());
  bundle.files["b.ies"] = "no lamp";
  const absl::Status refused = LoadGltf(bundle).status();
  EXPECT_EQ(ReasonOf(refused), "SCENE_INVALID");
  EXPECT_NE(refused.message().find("b.ies"), std::string::npos) << refused;
}

}  // namespace
}  // namespace lambert

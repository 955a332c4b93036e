// What LoadGltf keeps of a file beside what light needs.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "radiosity/scene/load_gltf.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

constexpr int kFloat = 5126;

absl::StatusOr<Scene> LoadAll(const GltfDocument& document) {
  return LoadGltf({"test.glb", document.Glb(), {}}, {}, Keep::kAppearance);
}

GltfDocument Shaded() {
  GltfDocument document;
  auto& attributes = document.Primitive()["attributes"];
  attributes["NORMAL"] =
      document.AddAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, kFloat, "VEC3", 3);
  attributes["TANGENT"] =
      document.AddAccessor<float>({2, 0, 0, -1, 1, 0, 0, -1, 1, 0, 0, -1}, kFloat, "VEC4", 3);
  document.Material()["normalTexture"] = {
      {"index", document.AddTexture(MakePng(1, 1, std::string(4, '\x80')))}, {"texCoord", 2}};
  for (const char* set : {"TEXCOORD_1", "TEXCOORD_2"}) {
    attributes[set] = document.AddAccessor<float>({0, 0, 1, 0, 0, 1}, kFloat, "VEC2", 3);
  }
  return document;
}

TEST(Appearance, MaterialsImagesAndVerticesAreKeptWhereItIsAsked) {
  const absl::StatusOr<Scene> scene = LoadAll(Shaded());
  ASSERT_TRUE(scene.ok()) << scene.status();
  const Primitive& primitive = scene->meshes[0].primitives[0];
  ASSERT_EQ(primitive.normals.size(), 3u);
  EXPECT_EQ(primitive.normals[0], (std::array<float, 3>{0, 0, 1}));
  ASSERT_EQ(primitive.tangents.size(), 3u);
  EXPECT_EQ(primitive.tangents[0], (std::array<float, 4>{1, 0, 0, -1})) << "of length 1";
  EXPECT_EQ(primitive.uv.size(), 3u);
  ASSERT_NE(scene->appearance, nullptr);
  const auto json = nlohmann::json::parse(scene->appearance->json);
  EXPECT_EQ(json["materials"][0]["normalTexture"]["texCoord"], 2);
  EXPECT_EQ(json["textures"][0]["source"], 0);
  EXPECT_EQ(json["samplers"], nlohmann::json::array());
  EXPECT_EQ(json["images"][0]["mimeType"], "image/png");
  EXPECT_EQ(scene->appearance->images[0].substr(1, 3), "PNG");
  EXPECT_TRUE(scene->textures.empty()) << "light needs no normal texture";
  const absl::StatusOr<Scene> plain = Shaded().Load();
  EXPECT_EQ(plain->appearance, nullptr);
  EXPECT_TRUE(plain->meshes[0].primitives[0].normals.empty());
  EXPECT_EQ(plain->meshes[0].primitives[0].uv.count(2), 0u);
}

TEST(Appearance, WhatIsBadIsLeftOut) {
  GltfDocument document = Shaded();
  auto& attributes = document.Primitive()["attributes"];
  attributes["TANGENT"] =
      document.AddAccessor<float>({1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1}, kFloat, "VEC4", 3);
  attributes["TEXCOORD_2"] = document.AddAccessor<float>({0, 0}, kFloat, "VEC2", 1);
  absl::StatusOr<Scene> scene = LoadAll(document);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_TRUE(scene->meshes[0].primitives[0].tangents.empty()) << "one has no length";
  EXPECT_EQ(scene->meshes[0].primitives[0].normals.size(), 3u);
  EXPECT_EQ(scene->meshes[0].primitives[0].uv.count(2), 0u) << "fewer than positions";
  attributes["NORMAL"] =
      document.AddAccessor<float>({0, 0, 1, 0, 0, 1, NAN, 0, 1}, kFloat, "VEC3", 3);
  scene = LoadAll(document);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_TRUE(scene->meshes[0].primitives[0].normals.empty());
}

// Half of a target that leans normals towards x, and tangents away from z; length 1 comes after.
TEST(Appearance, MorphTargetsMoveNormalsAndTangents) {
  GltfDocument document = Shaded();
  const auto all = [&document](float x, float y, float z) {
    return document.AddAccessor<float>({x, y, z, x, y, z, x, y, z}, kFloat, "VEC3", 3);
  };
  document.Primitive()["targets"] = {
      {{"POSITION", all(0, 0, 1)}, {"NORMAL", all(2, 0, 0)}, {"TANGENT", all(0, 0, -2)}},
      {{"POSITION", all(0, 0, 1)}, {"NORMAL", all(0, 9, 0)}}};
  document.json["meshes"][0]["weights"] = {0.5, 0};
  const absl::StatusOr<Scene> scene = LoadAll(document);
  ASSERT_TRUE(scene.ok()) << scene.status();
  const Primitive& primitive = scene->meshes[0].primitives[0];
  ASSERT_EQ(primitive.normals.size(), 3u);
  const float half = std::sqrt(0.5f);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(primitive.normals[1][axis], (std::array<float, 3>{half, 0, half})[axis], 1e-6);
    EXPECT_NEAR(primitive.tangents[1][axis], (std::array<float, 3>{half, 0, -half})[axis], 1e-6);
  }
  EXPECT_EQ(primitive.tangents[1][3], -1);
}

// A joint that turns by 90 degrees about x takes normals along.
TEST(Appearance, NormalsTurnWithTheirJoints) {
  GltfDocument document = Shaded();
  auto& attributes = document.Primitive()["attributes"];
  attributes["JOINTS_0"] = document.AddAccessor<uint8_t>(std::vector<uint8_t>(12), 5121, "VEC4", 3);
  attributes["WEIGHTS_0"] =
      document.AddAccessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, kFloat, "VEC4", 3);
  const float half = std::sqrt(0.5f);
  document.json["nodes"].push_back({{"rotation", {half, 0, 0, half}}, {"translation", {0, 5, 0}}});
  document.json["scenes"][0]["nodes"].push_back(1);
  document.json["skins"] = {{{"joints", {1}}}};
  document.Node()["skin"] = 0;
  const absl::StatusOr<Scene> scene = LoadAll(document);
  ASSERT_TRUE(scene.ok()) << scene.status();
  const Mesh& posed = scene->meshes[scene->instances[0].mesh];
  ASSERT_EQ(posed.primitives[0].normals.size(), 3u);
  EXPECT_NEAR(posed.primitives[0].normals[0][1], -1, 1e-6);
  EXPECT_NEAR(posed.primitives[0].tangents[0][0], 1, 1e-6);
}

}  // namespace
}  // namespace lambert

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "radiosity/core/error.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

using Row = std::array<double, 3>;

// The texture use of the document's material once `info` is its base colour texture.
TextureUse UseOf(GltfDocument document, const nlohmann::json& info) {
  document.Material()["pbrMetallicRoughness"]["baseColorTexture"] = info;
  const absl::StatusOr<Scene> scene = document.Load();
  EXPECT_TRUE(scene.ok()) << scene.status();
  EXPECT_TRUE(!scene.ok() || scene->warnings.empty());
  return scene.ok() ? scene->materials[0].reflectance_texture : TextureUse{};
}

nlohmann::json Transformed(int texture, const nlohmann::json& transform) {
  return {{"index", texture}, {"extensions", {{"KHR_texture_transform", transform}}}};
}

TEST(TextureTransform, MovesScalesThenTurnsAsTheSpecSays) {
  GltfDocument document;
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    document.json[list] = {"KHR_texture_transform"};
  }
  const int texture = document.AddTexture(MakePng(1, 1, std::string(4, '\x7f')));
  const TextureUse plain = UseOf(document, {{"index", texture}});
  EXPECT_EQ(plain.row_u, (Row{1, 0, 0}));
  EXPECT_EQ(plain.row_v, (Row{0, 1, 0}));
  // The spec's example: the lower left quadrant of the image, turned clockwise by 90 degrees.
  const TextureUse quadrant = UseOf(
      document,
      Transformed(texture,
                  {{"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}}));
  const Row u = {0, 0.5, 0}, v = {-0.5, 0, 1};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(quadrant.row_u[k], u[k], 1e-15);
    EXPECT_NEAR(quadrant.row_v[k], v[k], 1e-15);
  }
  const TextureUse flipped =
      UseOf(document, Transformed(texture, {{"offset", {0, 1}}, {"scale", {1, -1}}}));
  EXPECT_EQ(flipped.row_v, (Row{0, -1, 1}));
}

TEST(TextureTransform, BadValuesAreRefused) {
  GltfDocument document;
  const int texture = document.AddTexture(MakePng(1, 1, std::string(4, '\x7f')));
  for (const nlohmann::json& bad :
       {nlohmann::json{{"offset", {1}}}, nlohmann::json{{"rotation", "a"}},
        nlohmann::json{{"scale", {1, nullptr}}},
        nlohmann::json{{"scale", {1e308, 1}}, {"rotation", 1e308}, {"offset", 3}}}) {
    document.Material()["pbrMetallicRoughness"]["baseColorTexture"] = Transformed(texture, bad);
    EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID") << bad;
  }
}

TEST(TextureCoordinates, OfAnySetAreRead) {
  GltfDocument document;
  const int texture = document.AddTexture(MakePng(1, 1, std::string(4, '\x7f')));
  const int other = document.AddAccessor<uint16_t>({0, 0, 65535, 0, 65535, 65535}, 5123, "VEC2", 3);
  document.json["accessors"].back()["normalized"] = true;
  document.Primitive()["attributes"]["TEXCOORD_7"] = other;
  EXPECT_EQ(UseOf(document, {{"index", texture}, {"texCoord", 7}}).uv_set, 7);
  EXPECT_EQ(UseOf(document, Transformed(texture, {{"texCoord", 7}})).uv_set, 7);
  document.Material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture},
                                                                     {"texCoord", 7}};
  const Scene scene = *document.Load();
  const Primitive& primitive = scene.meshes[0].primitives[0];
  EXPECT_EQ(primitive.uv.at(7)[2], (std::array<float, 2>{1, 1}));
  EXPECT_EQ(primitive.uv.count(0), 1u);
  // What no texture asks for is not read.
  document.Material()["pbrMetallicRoughness"].erase("baseColorTexture");
  EXPECT_EQ(document.Load()->meshes[0].primitives[0].uv.count(7), 0u);
}

using Colors = std::vector<std::array<float, 4>>;

TEST(Textures, OfOtherFormatsAreReadByTheirFallback) {
  for (const char* name : {"KHR_texture_basisu", "EXT_texture_webp"}) {
    GltfDocument document;
    const int texture = document.AddTexture(MakePng(1, 1, {64, 64, 64, 127}));
    document.Material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", texture}};
    const int other = document.AddViewBytes("of another format");
    document.json["images"].push_back({{"bufferView", other}, {"mimeType", "image/webp"}});
    document.json["textures"][texture]["extensions"][name] = {{"source", 1}};
    absl::StatusOr<Scene> scene = document.Load();
    ASSERT_TRUE(scene.ok()) << scene.status();
    EXPECT_EQ(scene->textures.size(), 1u);
    EXPECT_TRUE(scene->warnings.empty());
    document.json["textures"][texture].erase("source");
    document.json["extensionsRequired"] = {name};
    scene = document.Load();
    ASSERT_TRUE(scene.ok()) << scene.status();
    EXPECT_TRUE(scene->textures.empty());
    ASSERT_EQ(scene->warnings.size(), 1u);
    EXPECT_EQ(scene->warnings[0].reason, "FEATURE_NOT_READ");
    EXPECT_NE(scene->warnings[0].message.find("no PNG or JPEG (1 texture)"), std::string::npos);
  }
}

TEST(VertexColours, OfEveryTypeAreRead) {
  GltfDocument document;
  const auto load = [&document](int accessor, bool normalized) {
    if (normalized) document.json["accessors"][accessor]["normalized"] = true;
    document.Primitive()["attributes"]["COLOR_0"] = accessor;
    const absl::StatusOr<Scene> scene = document.Load();
    EXPECT_TRUE(scene.ok() && scene->warnings.empty()) << scene.status();
    return scene.ok() ? scene->meshes[0].primitives[0].colors : Colors{};
  };
  const Colors opaque = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
  EXPECT_EQ(load(document.AddAccessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 1}, 5126, "VEC3", 3), false),
            opaque);
  EXPECT_EQ(load(document.AddAccessor<uint8_t>({255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0}, 5121,
                                               "VEC3", 3),
                 true)
                .size(),
            3u);
  Colors clear = opaque;
  for (auto& color : clear) color[3] = 0;
  EXPECT_EQ(load(document.AddAccessor<uint8_t>({255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0}, 5121,
                                               "VEC4", 3),
                 true),
            clear);
  EXPECT_EQ(
      load(document.AddAccessor<uint16_t>({65535, 0, 0, 0, 65535, 0, 0, 0, 65535}, 5123, "VEC3", 3),
           true),
      opaque);
}

TEST(VertexColours, OverOneAreTakenAsOneAndUnderZeroRefused) {
  GltfDocument document;
  document.Primitive()["attributes"]["COLOR_0"] =
      document.AddAccessor<float>({2, 0, 0, 0, 1, 0, 0, 0, 1}, 5126, "VEC3", 3);
  const Scene scene = *document.Load();
  EXPECT_EQ(scene.meshes[0].primitives[0].colors[0], (std::array<float, 4>{1, 0, 0, 1}));
  ASSERT_EQ(scene.warnings.size(), 1u);
  EXPECT_EQ(scene.warnings[0].reason, "REFLECTANCE_CLAMPED");
  for (float bad : {-0.1f, std::nanf(""), INFINITY}) {
    document.Primitive()["attributes"]["COLOR_0"] =
        document.AddAccessor<float>({0, 0, 0, 0, bad, 0, 0, 0, 1}, 5126, "VEC3", 3);
    EXPECT_NE(document.Load().status().message().find("colour 1"), std::string::npos);
  }
  document.Primitive()["attributes"]["COLOR_0"] =
      document.AddAccessor<float>({0, 0, 0}, 5126, "VEC3", 1);
  EXPECT_NE(document.Load().status().message().find("fewer COLOR_0"), std::string::npos);
}

TEST(Materials, OfSpecularAndGlossinessReflectTheirDiffuseColour) {
  GltfDocument document;
  document.json["extensionsRequired"] = {"KHR_materials_pbrSpecularGlossiness"};
  const int texture = document.AddTexture(MakePng(1, 1, std::string(4, '\x7f')));
  document.Material()["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
      {"diffuseFactor", {0.25, 0.5, 0.75, 0.4}},
      {"diffuseTexture", Transformed(texture, {{"offset", {3, 0}}})}};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->materials[0].reflectance, (Rgb{0.25, 0.5, 0.75}));
  EXPECT_EQ(scene->materials[0].alpha, 0.4);
  EXPECT_EQ(scene->materials[0].reflectance_texture.texture, 0);
  EXPECT_EQ(scene->materials[0].reflectance_texture.row_u, (Row{1, 0, 3}));
  EXPECT_TRUE(scene->warnings.empty());
}

TEST(Materials, ThatTransmitReflectTheRest) {
  GltfDocument document;
  auto& extensions = document.Material()["extensions"];
  extensions["KHR_materials_transmission"]["transmissionFactor"] = 0.5;
  extensions["KHR_materials_diffuse_transmission"]["diffuseTransmissionFactor"] = 0.5;
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->materials[0].reflectance, (Rgb{0.125, 0.125, 0.125}));
  EXPECT_EQ(scene->warnings.size(), 2u);
  extensions["KHR_materials_transmission"]["transmissionFactor"] = 1.5;
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID");
}

}  // namespace
}  // namespace lambert

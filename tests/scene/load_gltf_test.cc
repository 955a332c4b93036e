#include "radiosity/scene/load_gltf.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/core/error.h"
#include "tests/scene/gltf_document.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

using Triangle = std::array<uint32_t, 3>;

bool Mentions(const Scene& scene, const std::string& text) {
  for (const Warning& warning : scene.warnings) {
    if (warning.reason == "FEATURE_NOT_READ" && warning.message.find(text) != std::string::npos) {
      return true;
    }
  }
  return false;
}

TEST(LoadGltf, ReadsATriangleWithItsMaterial) {
  const absl::StatusOr<Scene> scene = GltfDocument().Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  ASSERT_EQ(scene->instances.size(), 1u);
  const Primitive& primitive = scene->meshes[0].primitives[0];
  EXPECT_EQ(primitive.triangles, (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(primitive.positions[1], (std::array<float, 3>{1, 0, 0}));
  EXPECT_EQ(scene->materials[0].reflectance, (Rgb{0.5, 0.5, 0.5}));
  EXPECT_EQ(scene->materials[0].luminance, (Rgb{1, 1, 1}));
  EXPECT_EQ(scene->node_names, std::vector<std::string>{"triangle"});
  EXPECT_TRUE(scene->warnings.empty());
}

TEST(LoadGltf, WhatToGlbWroteIsReadBackAlike) {
  const Scene cornell = MakeCornell(2);
  const absl::StatusOr<Scene> read = LoadGltf({"cornell.glb", ToGlb(cornell), {}});
  ASSERT_TRUE(read.ok()) << read.status();
  EXPECT_TRUE(read->warnings.empty());
  PatchSet made = PatchesOf(cornell), loaded = PatchesOf(*read);
  EXPECT_EQ(loaded.corners, made.corners);
  EXPECT_EQ(loaded.source, made.source);
  EXPECT_NEAR(EmittedFlux(loaded).r, EmittedFlux(made).r, 1e-9);
  EXPECT_EQ(loaded.cameras[0].world.translation, made.cameras[0].world.translation);
}

TEST(LoadGltf, StripsAlternateTheirWindingAndFansTurnAboutTheFirstVertex) {
  GltfDocument document;
  document.Primitive()["indices"] =
      document.AddAccessor<uint8_t>({0, 1, 2, 1, 0}, 5121, "SCALAR", 5);
  document.Primitive()["mode"] = 5;
  EXPECT_EQ(document.Load()->meshes[0].primitives[0].triangles,
            (std::vector<Triangle>{{0, 1, 2}, {1, 1, 2}, {2, 1, 0}}));
  document.Primitive()["mode"] = 6;
  // Of the list 0 1 2 1 0: (l1, l2, l0), (l2, l3, l0), (l3, l4, l0). Vertices are numbered as
  // they are met, so the file's 1 2 0 become 0 1 2.
  EXPECT_EQ(document.Load()->meshes[0].primitives[0].triangles,
            (std::vector<Triangle>{{0, 1, 2}, {1, 0, 2}, {0, 2, 2}}));
}

TEST(LoadGltf, TrianglesWithoutIndicesAndWithEveryIndexTypeAreAlike) {
  GltfDocument document;
  const std::vector<Triangle> expected = {{0, 1, 2}};
  document.Primitive().erase("indices");
  EXPECT_EQ(document.Load()->meshes[0].primitives[0].triangles, expected);
  document.Primitive()["indices"] = document.AddAccessor<uint8_t>({0, 1, 2}, 5121, "SCALAR", 3);
  EXPECT_EQ(document.Load()->meshes[0].primitives[0].triangles, expected);
  document.Primitive()["indices"] = document.AddAccessor<uint32_t>({0, 1, 2}, 5125, "SCALAR", 3);
  EXPECT_EQ(document.Load()->meshes[0].primitives[0].triangles, expected);
}

TEST(LoadGltf, PointsAndLinesAreLeftOutAndNamed) {
  GltfDocument document;
  for (int mode : {0, 1, 2, 3}) {
    document.Primitive()["mode"] = mode;
    const absl::StatusOr<Scene> scene = document.Load();
    ASSERT_TRUE(scene.ok());
    EXPECT_TRUE(scene->meshes[0].primitives[0].triangles.empty());
    EXPECT_TRUE(Mentions(*scene, "points and lines (1 primitive)"));
  }
}

TEST(LoadGltf, InterleavedAndSparseAndNormalisedAccessorsAreReadRight) {
  GltfDocument document;
  const int interleaved = document.AddView<float>({9, 9, 1, 2, 3, 9, 4, 5, 6, 9, 7, 8, 9, 9});
  document.json["bufferViews"][interleaved]["byteStride"] = 16;
  document.json["accessors"][0]["bufferView"] = interleaved;
  document.json["accessors"][0]["byteOffset"] = 8;
  const int where = document.AddView<uint8_t>({2});
  const int what = document.AddView<float>({-1, -2, -3});
  document.json["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", where}, {"componentType", 5121}}},
      {"values", {{"bufferView", what}}}};
  EXPECT_EQ(document.Load()->meshes[0].primitives[0].positions,
            (std::vector<std::array<float, 3>>{{1, 2, 3}, {4, 5, 6}, {-1, -2, -3}}));

  document = GltfDocument();
  document.Primitive()["attributes"]["POSITION"] = document.AddAccessor<int16_t>(
      {0, 0, 0, 0, 32767, -32768, -32767, 0, 0, 0, 0, 0}, 5122, "VEC3", 3);
  document.json["accessors"].back()["normalized"] = true;
  document.json["bufferViews"].back()["byteStride"] = 8;  // each vertex is padded to 8 bytes
  EXPECT_EQ(document.Load()->meshes[0].primitives[0].positions[1],
            (std::array<float, 3>{1, -1, -1}));
}

TEST(LoadGltf, IndicesMayBeSparseAlone) {
  GltfDocument document;
  document.json["accessors"].push_back({{"componentType", 5123}, {"type", "SCALAR"}, {"count", 3}});
  document.Primitive()["indices"] = 2;
  document.json["accessors"][2]["sparse"] = {
      {"count", 2},
      {"indices", {{"bufferView", document.AddView<uint8_t>({1, 2})}, {"componentType", 5121}}},
      {"values", {{"bufferView", document.AddView<uint16_t>({2, 1})}}}};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(Triangles(*scene)[0], (std::array<Vec3, 3>{Vec3{}, Vec3{0, 1, 0}, Vec3{1, 0, 0}}));
}

TEST(LoadGltf, UnusedVerticesCostNothing) {
  GltfDocument document;
  std::vector<float> many(3 * 50'000, std::nanf(""));
  for (int k = 0; k < 9; ++k) many[3 * 49'997 + k] = k * k;
  document.Primitive()["attributes"]["POSITION"] = document.AddAccessor(many, 5126, "VEC3", 50'000);
  document.Primitive()["indices"] =
      document.AddAccessor<uint32_t>({49'997, 49'998, 49'999}, 5125, "SCALAR", 3);
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->meshes[0].primitives[0].positions.size(), 3u);
}

TEST(LoadGltf, TransformsNestFromParentToChild) {
  GltfDocument document;
  const double h = std::sqrt(0.5);
  document.json["nodes"] = {
      {{"translation", {10, 0, 0}}, {"scale", {2, 2, 2}}, {"children", {1}}},
      {{"rotation", {0, 0, h, h}}, {"children", {2}}},  // a quarter turn about z
      {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1}}}};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  const Vec3 moved = scene->instances[0].world.Point({1, 0, 0});  // 1 + 3 along the turned x, twice
  EXPECT_NEAR(Length(moved - Vec3{10, 8, 0}), 0, 1e-12);
  EXPECT_NEAR(scene->instances[0].world.Determinant(), 8, 1e-12);
}

TEST(LoadGltf, EmissiveStrengthMultipliesAndMayExceedAnInt) {
  GltfDocument document;
  auto& strength =
      document.Material()["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
  strength = 2.5;
  EXPECT_EQ(document.Load()->materials[0].luminance, (Rgb{2.5, 2.5, 2.5}));
  strength = 1'000'000'000'000;
  EXPECT_EQ(document.Load()->materials[0].luminance.r, 1e12);
  strength = "5";
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID");
}

TEST(LoadGltf, AnimationsOfWhatIsNoNodeAreShownAtRest) {
  GltfDocument document;
  const int times = document.AddAccessor<float>({0}, 5126, "SCALAR", 1);
  const nlohmann::json pointer = {{"pointer", "/materials/0/pbrMetallicRoughness/roughnessFactor"}};
  document.json["extensionsUsed"] = {"KHR_animation_pointer"};
  document.json["animations"] = {
      {{"samplers", {{{"input", times}, {"output", times}}}},
       {"channels",
        {{{"sampler", 0},
          {"target",
           {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", pointer}}}}}}}}}};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_TRUE(Mentions(*scene, "animations (1 file): shown at rest"));
}

TEST(LoadGltf, OnlyTexturesThatShowAreDecoded) {
  GltfDocument document;
  const int good = document.AddTexture(MakePng(1, 1, std::string(4, '\x7f')));
  const int broken = document.AddTexture("this is no image");
  document.Material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = good;
  document.Material()["pbrMetallicRoughness"]["metallicRoughnessTexture"]["index"] = broken;
  document.Material()["normalTexture"]["index"] = broken;
  document.Material()["occlusionTexture"]["index"] = broken;
  document.Material()["emissiveTexture"]["index"] = broken;
  document.Material()["emissiveFactor"] = {0, 0, 0};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->textures.size(), 1u);
  EXPECT_EQ(scene->materials[0].reflectance_texture.texture, 0);
  EXPECT_EQ(scene->materials[0].luminance_texture.texture, -1);
  document.Material()["emissiveFactor"] = {1, 0, 0};
  EXPECT_NE(document.Load().status().message().find("image 1"), std::string::npos);
}

TEST(LoadGltf, AlphaIsReadForTheModeMaskAlone) {
  GltfDocument document;
  const int texture = document.AddTexture(MakePng(1, 1, std::string(4, '\x7f')));
  document.Material()["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0, 0, 0.75};
  document.Material()["pbrMetallicRoughness"]["baseColorTexture"]["index"] = texture;
  EXPECT_EQ(document.Load()->materials[0].alpha_cutoff, 0);
  EXPECT_TRUE(document.Load()->textures.empty()) << "black";
  document.Material()["alphaMode"] = "MASK";
  EXPECT_EQ(document.Load()->materials[0].alpha_cutoff, 0.5) << "the default of glTF";
  document.Material()["alphaCutoff"] = 0.25;
  const Scene scene = *document.Load();
  EXPECT_EQ(scene.materials[0].alpha_cutoff, 0.25);
  EXPECT_EQ(scene.materials[0].alpha, 0.75);
  EXPECT_EQ(scene.materials[0].reflectance_texture.texture, 0)
      << "its alpha shows, though it is black";
  EXPECT_FALSE(Mentions(scene, "alpha mode"));
}

TEST(LoadGltf, SamplersSetTheWrap) {
  GltfDocument document;
  const int texture = document.AddTexture(MakePng(1, 1, std::string(4, '\x7f')));
  document.Material()["emissiveTexture"]["index"] = texture;
  document.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  document.json["textures"][texture]["sampler"] = 0;
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->textures[0].wrap_u, Texture::Wrap::kClampToEdge);
  EXPECT_EQ(scene->textures[0].wrap_v, Texture::Wrap::kMirroredRepeat);
}

TEST(LoadGltf, CamerasLoseTheScaleOfTheirNode) {
  GltfDocument document;
  document.json["cameras"] = {
      {{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.1}}}},
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0.1}, {"zfar", 10}}}}};
  document.Node()["camera"] = 0;
  document.Node()["scale"] = {2, -3, 4};
  document.json["nodes"].push_back({{"camera", 1}, {"name", "plan"}});
  document.json["scenes"][0]["nodes"] = {0, 1};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  const Transform axes = scene->cameras[0].world;
  EXPECT_NEAR(axes.Determinant(), 1, 1e-15);
  EXPECT_NEAR(Length(axes.z - Vec3{0, 0, 1}), 0, 1e-15);
  EXPECT_EQ(scene->cameras[0].yfov_rad, 0.7);
  EXPECT_EQ(scene->cameras[0].aspect, 0);
  EXPECT_FALSE(scene->cameras[1].perspective);
  EXPECT_EQ(scene->cameras[1].half_height_m, 2);
  EXPECT_EQ(scene->cameras[1].aspect, 1.5);
  EXPECT_EQ(scene->cameras[1].name, "plan");
}

TEST(LoadGltf, EverythingThatIsNotReadIsNamedOnce) {
  GltfDocument document;
  document.Material()["alphaMode"] = "BLEND";
  document.Material()["pbrMetallicRoughness"]["metallicFactor"] = 1;
  document.Material()["extensions"]["KHR_materials_unlit"] = nlohmann::json::object();
  document.json["extensionsUsed"] = {"KHR_materials_sheen", "ACME_glow"};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  for (const char* feature :
       {"metalness", "KHR_materials_unlit", "KHR_materials_sheen", "extension ACME_glow"}) {
    EXPECT_TRUE(Mentions(*scene, feature)) << feature;
  }
  EXPECT_EQ(scene->warnings.size(), 4u);
  EXPECT_TRUE(scene->materials[0].blend);
}

TEST(LoadGltf, BadVertexNormalsAreCountedAndChangeNothing) {
  const float nan = std::nanf("");
  GltfDocument document;
  const auto load = [&document](const std::vector<float>& normals) {
    document.Primitive()["attributes"]["NORMAL"] =
        document.AddAccessor<float>(normals, 5126, "VEC3", normals.size() / 3);
    return *document.Load();
  };
  for (float z : {1.0f, 0.995f, 1.005f}) {
    EXPECT_TRUE(load({0, 0, z, 0, 0, z, 0, 0, z}).warnings.empty()) << z;
  }
  EXPECT_TRUE(load({0, 0, 1, 1, 0, 0, 0, 0.6f, -0.8f}).warnings.empty()) << "leaning";
  for (const std::vector<float>& bad :
       std::vector<std::vector<float>>{{0, 0, 1, 0, 0, 1, 0, 0, 1000},
                                       {0, 0, 0, 0, 0, 1, 0, 0, 1},
                                       {0, 0, -1, 0, 0, -1, 0, 0, -1},
                                       {0, 0, 1, nan, 0, 1, 0, 0, 1},
                                       {0, 0, 1, 0, 0, 1}}) {
    const Scene scene = load(bad);
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_EQ(scene.warnings[0].reason, "BAD_VERTEX_NORMALS");
    EXPECT_NE(scene.warnings[0].message.find("1 triangle(s)"), std::string::npos);
    EXPECT_EQ(scene.meshes[0].primitives[0].positions,
              GltfDocument().Load()->meshes[0].primitives[0].positions);
  }
}

TEST(LoadGltf, OnlyTheDefaultSceneIsRead) {
  GltfDocument document;
  document.json["nodes"].push_back({{"mesh", 0}});
  document.json["scenes"] = {{{"nodes", {0}}}, {{"nodes", {1}}}};
  document.json["scene"] = 1;
  EXPECT_EQ(document.Load()->instances.at(0).node, 1);
  document.json.erase("scene");
  EXPECT_EQ(document.Load()->instances.at(0).node, 0);
  document.json.erase("scenes");
  EXPECT_EQ(document.Load()->instances.size(), 2u);
}

TEST(LoadGltf, BuffersAndImagesComeFromTheBundle) {
  GltfDocument document;
  const int texture = document.AddTexture(MakePng(1, 1, std::string(4, '\x7f')));
  document.Material()["emissiveTexture"]["index"] = texture;
  document.json["images"][0] = {{"uri", "my%20lamp+glow.png"}};
  const std::string glb = document.Glb();
  const size_t json_bytes = document.json.dump().size();
  const std::string buffer = glb.substr((20 + json_bytes + 3) / 4 * 4 + 8,
                                        document.json["buffers"][0]["byteLength"].get<size_t>());
  document.json["buffers"][0]["uri"] = "room.bin";
  SceneBundle bundle{"room.gltf", document.json.dump(), {}};
  EXPECT_EQ(*ListExternalFiles(bundle.main_name, bundle.main_bytes),
            (std::vector<std::string>{"room.bin", "my lamp+glow.png"}));
  EXPECT_NE(LoadGltf(bundle).status().message().find("room.bin"), std::string::npos);
  bundle.files["room.bin"] = buffer;
  EXPECT_NE(LoadGltf(bundle).status().message().find("did not come"), std::string::npos);
  bundle.files["my lamp+glow.png"] = MakePng(1, 1, std::string(4, '\x7f'));
  const absl::StatusOr<Scene> scene = LoadGltf(bundle);
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->textures.at(0).rgba[0], 0x7f);
}

}  // namespace
}  // namespace lambert

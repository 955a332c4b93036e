// Instances, morph targets and skins.
#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

using Position = std::array<float, 3>;

constexpr int kByte = 5121, kFloat = 5126;

// World positions of the first triangle of instance `i`.
std::vector<Vec3> Placed(const Scene& scene, size_t i) {
  const Instance& instance = scene.instances.at(i);
  std::vector<Vec3> placed;
  for (const Position& p : scene.meshes.at(instance.mesh).primitives.at(0).positions) {
    placed.push_back(instance.world.Point(FromFloats(p)));
  }
  return placed;
}

TEST(Instancing, PlacesEachInstanceInsideItsNode) {
  GltfDocument document;
  document.json["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  document.Node()["translation"] = {10, 0, 0};
  const float half = std::sqrt(0.5f);
  const int translation = document.AddAccessor<float>({1, 2, 3, 0, 0, 0}, kFloat, "VEC3", 2);
  const int rotation =
      document.AddAccessor<float>({0, 0, half, half, 0, 0, 0, 1}, kFloat, "VEC4", 2);
  const int scale = document.AddAccessor<float>({2, 2, 2, -1, 1, 1}, kFloat, "VEC3", 2);
  auto& attributes = document.Node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes = {{"TRANSLATION", translation}, {"ROTATION", rotation}, {"SCALE", scale}};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  ASSERT_EQ(scene->instances.size(), 2u);
  EXPECT_TRUE(scene->warnings.empty());
  // Corner (1, 0, 0), twice as far, turned by 90 degrees about z, moved by both.
  const Vec3 turned = Placed(*scene, 0)[1];
  EXPECT_NEAR(Length(turned - Vec3{11, 4, 3}), 0, 1e-6);
  EXPECT_EQ(Placed(*scene, 1)[1], (Vec3{9, 0, 0}));
  // The mirrored instance keeps its front in front: BuildPatches turns the winding.
  const absl::StatusOr<PatchSet> patches = BuildPatches(*scene, {});
  ASSERT_TRUE(patches.ok());
  for (PatchIndex i = 0; i < 2; ++i) EXPECT_GT(PatchNormal(*patches, i).z, 0.99);
  attributes["SCALE"] = document.AddAccessor<float>({1, 1, 1}, kFloat, "VEC3", 1);
  EXPECT_NE(document.Load().status().message().find("differ in their count"), std::string::npos);
  attributes["SCALE"] = "many";
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID");
}

TEST(Instancing, BombsAreRefusedBeforeAnInstanceIsMade) {
  GltfDocument document;
  document.json["accessors"].push_back(
      {{"componentType", kFloat}, {"type", "VEC3"}, {"count", 1000}});  // zeros
  for (int node = 0; node < 3; ++node) {
    document.json["nodes"][node] = {
        {"mesh", 0},
        {"extensions",
         {{"EXT_mesh_gpu_instancing",
           {{"attributes", {{"TRANSLATION", document.json["accessors"].size() - 1}}}}}}}};
  }
  document.json["scenes"][0]["nodes"] = {0, 1, 2};
  SceneLimits limits;
  limits.instances = 2999;
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE");
  limits.instances = 3000;
  limits.triangles = 3000;
  EXPECT_TRUE(document.Load(limits).ok());
  limits.triangles -= 1;
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE") << "instances count";
}

// Two morph targets: one lifts corner 1 by 1, the other moves all by 2 along y.
GltfDocument Morphed() {
  GltfDocument document;
  const int lift = document.AddAccessor<float>({0, 0, 0, 0, 0, 1, 0, 0, 0}, kFloat, "VEC3", 3);
  const int move = document.AddAccessor<float>({0, 2, 0, 0, 2, 0, 0, 2, 0}, kFloat, "VEC3", 3);
  document.Primitive()["targets"] = {{{"POSITION", lift}}, {{"POSITION", move}}};
  return document;
}

TEST(MorphTargets, AreAddedWithTheWeightsOfTheMesh) {
  GltfDocument document = Morphed();
  EXPECT_EQ(Placed(*document.Load(), 0)[1], (Vec3{1, 0, 0})) << "no weights: at rest";
  document.json["meshes"][0]["weights"] = {0.5, 0.25};
  EXPECT_EQ(Placed(*document.Load(), 0)[1], (Vec3{1, 0.5, 0.5}));
  EXPECT_TRUE(document.Load()->warnings.empty());
}

TEST(MorphTargets, OfANodeWithItsOwnWeightsAreApartFromTheMesh) {
  GltfDocument document = Morphed();
  document.json["meshes"][0]["weights"] = {1, 0};
  document.json["nodes"].push_back({{"mesh", 0}, {"weights", {0, 1}}});
  document.json["scenes"][0]["nodes"] = {0, 1};
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(Placed(*scene, 0)[1], (Vec3{1, 0, 1}));
  EXPECT_EQ(Placed(*scene, 1)[1], (Vec3{1, 2, 0}));
  const absl::StatusOr<PatchSet> patches = BuildPatches(*scene, {});
  ASSERT_TRUE(patches.ok());
  EXPECT_EQ(patches->source[0].mesh, 0);
  EXPECT_EQ(patches->source[1].mesh, 0);
}

TEST(MorphTargets, ThatLieOrMoveTooMuchAreRefused) {
  GltfDocument document = Morphed();
  document.json["meshes"][0]["weights"] = {1, 1};
  SceneLimits limits;
  limits.triangles = 5;
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE");
  limits.triangles = 6;
  EXPECT_TRUE(document.Load(limits).ok());
  document.Primitive()["targets"][1]["POSITION"] =
      document.AddAccessor<float>({0, 0, 0}, kFloat, "VEC3", 1);
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID");
  const int uv = document.AddAccessor<float>(std::vector<float>(6), kFloat, "VEC2", 3);
  document.Primitive()["attributes"]["TEXCOORD_0"] = uv;
  document.Primitive()["targets"][1] = {{"TEXCOORD_0", uv}};
  EXPECT_EQ(document.Load()->warnings.size(), 1u);
}

// Corners 0 and 1 follow joint 0 (node 1, at x = 5), corner 2 both halves; joint 1 (node 2) is a
// child of joint 0, 4 higher. The inverse bind matrices take joint 0 from the origin and joint 1
// from y = 1.
GltfDocument Skinned() {
  GltfDocument document;
  document.json["nodes"] = {{{"mesh", 0}, {"skin", 0}, {"translation", {100, 100, 100}}},
                            {{"translation", {5, 0, 0}}, {"children", {2}}},
                            {{"translation", {0, 4, 0}}}};
  document.json["scenes"][0]["nodes"] = {0, 1};
  document.Primitive()["attributes"]["JOINTS_0"] =
      document.AddAccessor<uint8_t>({0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0}, kByte, "VEC4", 3);
  document.Primitive()["attributes"]["WEIGHTS_0"] =
      document.AddAccessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0}, kFloat, "VEC4", 3);
  const int matrices =
      document.AddAccessor<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0,  0, 1,  //
                                   1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1},
                                  kFloat, "MAT4", 2);
  document.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", matrices}}};
  return document;
}

TEST(Skins, PutVerticesWhereTheirJointsAreAndIgnoreTheNode) {
  GltfDocument document = Skinned();
  absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_TRUE(scene->warnings.empty());
  EXPECT_EQ(Placed(*scene, 0), (std::vector<Vec3>{{5, 0, 0}, {6, 0, 0}, {5, 2.5, 0}}));
  // Without inverse bind matrices vertices are in the space of each joint.
  document.json["skins"][0].erase("inverseBindMatrices");
  EXPECT_EQ(Placed(*document.Load(), 0)[2], (Vec3{5, 3, 0}));
}

TEST(Skins, OfAllWeightsZeroFollowTheFirstJoint) {
  GltfDocument document = Skinned();
  document.Primitive()["attributes"]["WEIGHTS_0"] =
      document.AddAccessor<float>(std::vector<float>(12), kFloat, "VEC4", 3);
  EXPECT_EQ(Placed(*document.Load(), 0)[2], (Vec3{5, 1, 0}));
}

TEST(Skins, ThatNameWhatIsNotThereAreRefused) {
  const auto expect_refused = [](const GltfDocument& document, const std::string& what) {
    const absl::Status status = document.Load().status();
    EXPECT_EQ(ReasonOf(status), "SCENE_INVALID") << what;
    EXPECT_NE(status.message().find(what), std::string::npos) << status;
  };
  GltfDocument document = Skinned();
  document.Node()["skin"] = 7;
  expect_refused(document, "skin 7 does not exist");
  document = Skinned();
  document.json["skins"][0]["joints"] = {1};
  document.json["skins"][0].erase("inverseBindMatrices");
  expect_refused(document, "joint 1 of its skin is not in the scene");
  document = Skinned();
  document.json["scenes"][0]["nodes"] = {0};
  expect_refused(document, "no joint in the scene");
  document = Skinned();
  document.Primitive()["attributes"].erase("JOINTS_0");
  expect_refused(document, "no joints and weights");
  document = Skinned();
  document.json["skins"][0]["joints"] = {1, 2, 2};
  expect_refused(document, "a matrix of floats for each joint");
  document = Skinned();
  document.Primitive()["attributes"]["WEIGHTS_0"] =
      document.AddAccessor<float>({1, 0, 0, 0}, kFloat, "VEC4", 1);
  expect_refused(document, "fewer WEIGHTS_0");
}

TEST(Skins, SharedByManyNodesCountAsInstances) {
  GltfDocument document = Skinned();
  document.json["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
  document.json["scenes"][0]["nodes"] = {0, 1, 3};
  SceneLimits limits;
  limits.triangles = 1;
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE");
  EXPECT_EQ(document.Load()->meshes.size(), 3u) << "one of the file, and two poses";
}

}  // namespace
}  // namespace lambert

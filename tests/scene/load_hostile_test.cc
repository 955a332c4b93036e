// Files that lie: each is refused by name, in bounded time and memory.
#include <gtest/gtest.h>

#include <limits>

#include "radiosity/core/error.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

void ExpectRefused(const GltfDocument& document, const std::string& text) {
  const absl::Status status = document.Load().status();
  EXPECT_EQ(ReasonOf(status), "SCENE_INVALID") << status;
  EXPECT_NE(status.message().find(text), std::string::npos) << status;
  EXPECT_EQ(status.message().find('\n'), std::string::npos) << status;
}

TEST(HostileGltf, EveryTruncationAndEveryFlippedByteEndsWell) {
  const std::string glb = GltfDocument().Glb();
  for (size_t i = 0; i < glb.size(); ++i) {
    (void)LoadGltf({"cut.glb", glb.substr(0, i), {}});
    std::string flipped = glb;
    flipped[i] = static_cast<char>(flipped[i] ^ 0x15);
    (void)LoadGltf({"flipped.glb", flipped, {}});
  }
}

TEST(HostileGltf, IndicesThatNameNothingAreRefused) {
  for (int bad : {-7, 99, std::numeric_limits<int>::max()}) {
    GltfDocument document;
    document.Primitive()["attributes"]["POSITION"] = bad;
    EXPECT_FALSE(document.Load().ok());
    document = GltfDocument();
    document.Primitive()["material"] = bad;
    ExpectRefused(document, "material");
    document = GltfDocument();
    document.Node()["mesh"] = bad;
    ExpectRefused(document, "mesh");
    document = GltfDocument();
    document.Node()["camera"] = bad;
    ExpectRefused(document, "camera");
    document = GltfDocument();
    document.Node()["children"] = {bad};
    ExpectRefused(document, "child");
    document = GltfDocument();
    document.Node()["extensions"]["KHR_lights_punctual"]["light"] = bad;
    ExpectRefused(document, "light");
    document = GltfDocument();
    document.json["bufferViews"][0]["buffer"] = bad;
    ExpectRefused(document, "buffer");
    document = GltfDocument();
    document.json["accessors"][0]["bufferView"] = bad < 0 ? 99 : bad;
    ExpectRefused(document, "buffer view");
  }
  GltfDocument document;
  document.json["scene"] = 5;
  ExpectRefused(document, "scene 5");
  document = GltfDocument();
  document.json["scenes"][0]["nodes"] = {0, 0};
  ExpectRefused(document, "twice");
}

TEST(HostileGltf, RangesThatRunPastTheirDataAreRefused) {
  for (uint64_t huge : {uint64_t{1000}, uint64_t{1} << 33, uint64_t{1} << 62}) {
    GltfDocument document;
    document.json["accessors"][0]["count"] = huge;
    ExpectRefused(document, "accessor 0");
    document = GltfDocument();
    document.json["accessors"][0]["byteOffset"] = huge;
    ExpectRefused(document, "accessor 0");
    document = GltfDocument();
    document.json["bufferViews"][0]["byteOffset"] = huge;
    ExpectRefused(document, "buffer view 0");
    document = GltfDocument();
    document.json["bufferViews"][0]["byteLength"] = huge;
    ExpectRefused(document, "buffer view 0");
  }
  GltfDocument document;
  document.Primitive()["indices"] = document.AddAccessor<uint8_t>({0, 1, 3}, 5121, "SCALAR", 3);
  ExpectRefused(document, "index 3");
}

TEST(HostileGltf, SparsePartsAreChecked) {
  const auto with_sparse = [](int count, uint8_t index) {
    GltfDocument document;
    const int where = document.AddView<uint8_t>({index});
    const int what = document.AddView<float>({1, 2, 3});
    document.json["accessors"][0]["sparse"] = {
        {"count", count},
        {"indices", {{"bufferView", where}, {"componentType", 5121}}},
        {"values", {{"bufferView", what}}}};
    return document;
  };
  EXPECT_TRUE(with_sparse(1, 2).Load().ok());
  ExpectRefused(with_sparse(1, 3), "sparse index 3");
  ExpectRefused(with_sparse(2, 0), "sparse");
  ExpectRefused(with_sparse(-1, 0), "sparse");
}

TEST(HostileGltf, ZerosFromNothingStaySmall) {
  GltfDocument document;
  document.json["accessors"][0].erase("bufferView");
  document.json["accessors"][0]["count"] = 1'000'000'000;
  document.Primitive().erase("indices");
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_TOO_LARGE");
}

TEST(HostileGltf, NodesInsideThemselvesAndWithTwoParentsAreRefused) {
  GltfDocument document;
  document.Node()["children"] = {0};
  ExpectRefused(document, "inside itself");
  document = GltfDocument();
  document.json["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}};
  ExpectRefused(document, "two parents");
  document = GltfDocument();
  document.json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"children", {1}}}};
  ExpectRefused(document, "inside itself");
}

TEST(HostileGltf, ADeepChainOfNodesCostsNoStack) {
  GltfDocument document;
  constexpr int kDepth = 20'000;
  document.json["nodes"] = nlohmann::json::array();
  for (int i = 0; i + 1 < kDepth; ++i) document.json["nodes"].push_back({{"children", {i + 1}}});
  document.json["nodes"].push_back({{"mesh", 0}});
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(scene->instances[0].node, kDepth - 1);
}

TEST(HostileGltf, TransformsAndPositionsThatAreNotFiniteAreRefused) {
  GltfDocument document;
  document.json["nodes"] = {{{"scale", {1e200, 1, 1}}, {"children", {1}}},
                            {{"scale", {1e200, 1, 1}}, {"mesh", 0}}};
  ExpectRefused(document, "node 1");
  document = GltfDocument();
  document.Node()["rotation"] = {0, 0, 0, 0};
  ExpectRefused(document, "rotation");
  document = GltfDocument();
  document.Node()["matrix"] = {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  ExpectRefused(document, "affine");
  document = GltfDocument();
  document.Node()["scale"] = {1, 2};
  ExpectRefused(document, "length");
  document = GltfDocument();
  const float inf = std::numeric_limits<float>::infinity();
  document.Primitive()["attributes"]["POSITION"] =
      document.AddAccessor<float>({0, 0, 0, 1, 0, 0, 0, inf, 0}, 5126, "VEC3", 3);
  ExpectRefused(document, "position 2");
}

TEST(HostileGltf, VersionsAndRequiredExtensionsAreRefusedByName) {
  GltfDocument document;
  document.json["asset"]["version"] = "1.0";
  ExpectRefused(document, "1.0");
  document.json["asset"]["version"] = "2.7";
  EXPECT_TRUE(document.Load().ok());
  document.json["asset"]["minVersion"] = "2.7";
  ExpectRefused(document, "2.7");
  document = GltfDocument();
  document.json["extensionsRequired"] = {"ACME_mirrors"};
  EXPECT_EQ(ReasonOf(document.Load().status()), "EXTENSION_UNSUPPORTED");
  EXPECT_NE(document.Load().status().message().find("ACME_mirrors"), std::string::npos);
}

TEST(HostileGltf, LimitsAreKeptBeforeAnythingIsMade) {
  GltfDocument document;
  SceneLimits limits;
  limits.triangles = 0;
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE");
  limits.triangles = 1;
  EXPECT_TRUE(document.Load(limits).ok());
  document.json["nodes"].push_back({{"mesh", 0}});
  document.json["scenes"][0]["nodes"] = {0, 1};
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE");
  limits = {};
  limits.bytes = 100;
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE");
}

TEST(HostileGltf, ImagesAreMeasuredBeforeTheyAreDecoded) {
  GltfDocument document;
  document.Material()["emissiveTexture"]["index"] =
      document.AddTexture(MakePng(10'000, 10'000, ""));
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_TOO_LARGE");
  document = GltfDocument();
  document.Material()["emissiveTexture"]["index"] =
      document.AddTexture(MakePng(2, 1, std::string(8, '\x10')));
  SceneLimits limits;
  limits.total_pixels = 1;
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE");
  EXPECT_TRUE(document.Load().ok());
}

TEST(HostileGltf, FilesOutsideTheFolderAreNeitherListedNorRead) {
  for (const char* uri :
       {"../secret.bin", "/etc/passwd", "file:///etc/passwd", "a\\b", "%2e%2e/x"}) {
    GltfDocument document;
    document.json["buffers"][0]["uri"] = uri;
    EXPECT_FALSE(ListExternalFiles("room.gltf", document.json.dump()).ok()) << uri;
    EXPECT_FALSE(LoadGltf({"room.gltf", document.json.dump(), {}}).ok()) << uri;
  }
}

TEST(HostileGltf, NoiseIsOneLine) {
  for (const std::string& noise :
       {std::string(), std::string("{"), std::string("[]"), std::string("null"),
        std::string("glTF"), std::string("{\"asset\":{\"version\":\"\\u0000\\n2\"}}"),
        std::string("{\"a\":\"\xff\xfe\"}"), std::string(1000, '\0')}) {
    const absl::Status status = LoadGltf({"noise", noise, {}}).status();
    EXPECT_EQ(ReasonOf(status), "SCENE_INVALID");
    EXPECT_EQ(status.message().find('\n'), std::string::npos);
    EXPECT_FALSE(ListExternalFiles("noise", noise).ok() && noise.size() < 8);
  }
}

TEST(HostileGltf, LongNamesAreCutBetweenCharacters) {
  GltfDocument document;
  std::string name = "x";
  while (name.size() < 100'000) name += "\xc3\xbc";  // u with diaeresis
  document.Node()["name"] = name;
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok());
  EXPECT_EQ(scene->node_names[0].size(), 255u);
  EXPECT_EQ(scene->warnings.size(), 1u);
}

}  // namespace
}  // namespace lambert

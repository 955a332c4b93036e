// Meshes compressed by meshopt, made here by its encoder.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>

#include "radiosity/core/error.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

constexpr int kShort = 5122, kUnsignedShort = 5123, kFloat = 5126;

// Adds a view over `bytes` that stands for `count` elements of `stride` bytes.
int AddCompressed(const std::vector<unsigned char>& bytes, size_t count, size_t stride,
                  const std::string& mode, const std::string& filter, GltfDocument* document) {
  const int data = document->AddView(bytes);
  const nlohmann::json view = document->json["bufferViews"][data];
  auto& views = document->json["bufferViews"];
  document->json["buffers"][1] = {
      {"byteLength", 1 << 30}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}};
  views[data] = {{"buffer", 1}, {"byteLength", count * stride}};
  if (mode == "ATTRIBUTES") views[data]["byteStride"] = stride;
  views[data]["extensions"]["EXT_meshopt_compression"] = {
      {"buffer", 0},
      {"byteOffset", view.value("byteOffset", 0)},
      {"byteLength", bytes.size()},
      {"byteStride", stride},
      {"count", count},
      {"mode", mode},
      {"filter", filter}};
  document->json["extensionsRequired"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  document->json["extensionsUsed"] = {"KHR_mesh_quantization"};
  return data;
}

std::vector<unsigned char> EncodeVertices(const void* vertices, size_t count, size_t stride) {
  std::vector<unsigned char> bytes(meshopt_encodeVertexBufferBound(count, stride));
  bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), vertices, count, stride));
  return bytes;
}

// An accessor of a view that AddCompressed made.
int AddAccessorOf(int view, int component_type, const std::string& type, size_t count,
                  GltfDocument* document) {
  document->json["accessors"].push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"type", type}, {"count", count}});
  return static_cast<int>(document->json["accessors"].size()) - 1;
}

const std::vector<float> kSquare = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const std::vector<unsigned> kSquareIndices = {0, 1, 2, 0, 2, 3};

// The square with compressed positions and indices of a mode.
GltfDocument MeshoptSquare(const std::string& index_mode) {
  GltfDocument document;
  document.Primitive()["attributes"]["POSITION"] = AddAccessorOf(
      AddCompressed(EncodeVertices(kSquare.data(), 4, 12), 4, 12, "ATTRIBUTES", "NONE", &document),
      kFloat, "VEC3", 4, &document);
  std::vector<unsigned char> bytes(1000);
  bytes.resize(
      index_mode == "TRIANGLES"
          ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), kSquareIndices.data(), 6)
          : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), kSquareIndices.data(), 6));
  document.Primitive()["indices"] =
      AddAccessorOf(AddCompressed(bytes, 6, 2, index_mode, "NONE", &document), kUnsignedShort,
                    "SCALAR", 6, &document);
  return document;
}

TEST(Meshopt, VerticesAndIndicesAreDecoded) {
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    const absl::StatusOr<Scene> scene = MeshoptSquare(mode).Load();
    ASSERT_TRUE(scene.ok()) << scene.status();
    EXPECT_TRUE(scene->warnings.empty());
    const auto triangles = Triangles(*scene);
    ASSERT_EQ(triangles.size(), 2u);
    EXPECT_EQ(AreaOf(triangles), 1);
    EXPECT_EQ(Cross(triangles[0][1] - triangles[0][0], triangles[0][2] - triangles[0][0]),
              (Vec3{0, 0, 1}));
  }
}

TEST(Meshopt, FallbackBuffersAreNotAskedFor) {
  GltfDocument document = MeshoptSquare("TRIANGLES");
  document.json["buffers"][1]["uri"] = "fallback.bin";
  EXPECT_TRUE(document.Load().ok());
  EXPECT_TRUE(ListExternalFiles("test.glb", document.Glb())->empty());
}

TEST(Meshopt, FiltersAreUndone) {
  GltfDocument document;
  std::vector<uint32_t> exponential(12);
  meshopt_encodeFilterExp(exponential.data(), 4, 12, 15, kSquare.data());
  document.Primitive()["attributes"]["POSITION"] =
      AddAccessorOf(AddCompressed(EncodeVertices(exponential.data(), 4, 12), 4, 12, "ATTRIBUTES",
                                  "EXPONENTIAL", &document),
                    kFloat, "VEC3", 4, &document);
  // Normals to the front and quaternions of half a turn about z.
  const std::vector<float> normals = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<int16_t> octahedral(16);
  meshopt_encodeFilterOct(octahedral.data(), 4, 8, 16, normals.data());
  const int normal = AddAccessorOf(AddCompressed(EncodeVertices(octahedral.data(), 4, 8), 4, 8,
                                                 "ATTRIBUTES", "OCTAHEDRAL", &document),
                                   kShort, "VEC3", 4, &document);
  document.json["accessors"][normal]["normalized"] = true;
  document.Primitive()["attributes"]["NORMAL"] = normal;
  const std::vector<float> turns = {0, 0, 1, 0, 0, 0, 1, 0};
  std::vector<int16_t> quaternions(8);
  meshopt_encodeFilterQuat(quaternions.data(), 2, 8, 16, turns.data());
  const int rotation = AddAccessorOf(AddCompressed(EncodeVertices(quaternions.data(), 2, 8), 2, 8,
                                                   "ATTRIBUTES", "QUATERNION", &document),
                                     kShort, "VEC4", 2, &document);
  document.json["accessors"][rotation]["normalized"] = true;
  document.Node()["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["ROTATION"] = rotation;
  const absl::StatusOr<Scene> scene = document.Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_EQ(Triangles(*scene)[0][1], (Vec3{1, 0, 0}));
  EXPECT_TRUE(scene->warnings.empty()) << "the normals are good";
  ASSERT_EQ(scene->instances.size(), 2u);
  EXPECT_NEAR(Length(scene->instances[1].world.Point({1, 0, 0}) - Vec3{-1, 0, 0}), 0, 1e-3);
}

TEST(Meshopt, WhatLiesIsRefusedBeforeItTakesMemory) {
  const auto extension_of = [](GltfDocument* document) -> nlohmann::json& {
    return document->json["bufferViews"].back()["extensions"]["EXT_meshopt_compression"];
  };
  for (const auto& [field, value] :
       std::vector<std::pair<std::string, nlohmann::json>>{{"count", 300'000'000},
                                                           {"count", "many"},
                                                           {"count", -3},
                                                           {"buffer", 9},
                                                           {"byteLength", 1 << 30},
                                                           {"byteOffset", 1 << 30},
                                                           {"byteStride", 3},
                                                           {"mode", "NEWER"},
                                                           {"mode", 7},
                                                           {"filter", "QUATERNION"},
                                                           {"byteOffset", 1}}) {
    GltfDocument document = MeshoptSquare("TRIANGLES");
    extension_of(&document)[field] = value;
    const absl::Status status = document.Load().status();
    EXPECT_EQ(ReasonOf(status), "SCENE_INVALID") << field << " " << value;
  }
  SceneLimits limits;
  const GltfDocument document = MeshoptSquare("TRIANGLES");
  limits.bytes = static_cast<int64_t>(document.Glb().size());
  EXPECT_TRUE(document.Load(limits).ok());
  GltfDocument large;
  const std::vector<float> zeros(30'000);
  large.Primitive()["attributes"]["POSITION"] =
      AddAccessorOf(AddCompressed(EncodeVertices(zeros.data(), 10'000, 12), 10'000, 12,
                                  "ATTRIBUTES", "NONE", &large),
                    kFloat, "VEC3", 10'000, &large);
  EXPECT_TRUE(large.Load().ok()) << "as small as the codec makes it";
  limits.bytes = 119'999;
  EXPECT_EQ(ReasonOf(large.Load(limits).status()), "SCENE_TOO_LARGE");
}

TEST(Meshopt, DamagedBytesAreOneLine) {
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    const std::string good = MeshoptSquare(mode).Glb();
    const size_t begin = good.find("BIN") + 4;
    for (size_t at = begin; at < good.size(); ++at) {
      for (const char code : {'\x00', '\x7f', '\xff'}) {
        std::string bad = good;
        bad[at] = code;
        const absl::Status status = LoadGltf({"bad.glb", bad, {}}).status();
        EXPECT_TRUE(status.ok() || !ReasonOf(status).empty()) << mode << at << ": " << status;
      }
    }
    GltfDocument document = MeshoptSquare(mode);
    nlohmann::json& bytes =
        document.json["bufferViews"].back()["extensions"]["EXT_meshopt_compression"]["byteLength"];
    for (int length = bytes.get<int>() - 1; length > 0; --length) {
      bytes = length;
      EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID") << mode << length;
    }
  }
}

TEST(Meshopt, IndicesAndCountsBeyondTheVerticesAreRefused) {
  GltfDocument document = MeshoptSquare("INDICES");
  const std::vector<unsigned> indices = {0, 1, 2, 0, 2, 4};  // of four vertices
  std::vector<unsigned char> bytes(1000);
  bytes.resize(meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), 6));
  const int view = AddCompressed(bytes, 6, 2, "INDICES", "NONE", &document);
  const int accessor = document.Primitive()["indices"];
  document.json["accessors"][accessor]["bufferView"] = view;
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID");
  for (const char* what : {"POSITION", "indices"}) {
    GltfDocument lie = MeshoptSquare("TRIANGLES");
    const int of = what == std::string("indices") ? lie.Primitive()["indices"].get<int>()
                                                  : lie.Primitive()["attributes"][what].get<int>();
    lie.json["accessors"][of]["count"] = 1'000'000'000;
    EXPECT_EQ(ReasonOf(lie.Load().status()), "SCENE_INVALID") << what;
  }
}

}  // namespace
}  // namespace lambert

// Meshes compressed by Draco and meshopt, made here by the encoders of both.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <cmath>

#include "radiosity/core/error.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

constexpr int kShort = 5122, kUnsignedShort = 5123, kFloat = 5126;

// The corners of every triangle of the first mesh, in the order of the file.
std::vector<std::array<Vec3, 3>> Triangles(const Scene& scene) {
  const Primitive& primitive = scene.meshes.at(0).primitives.at(0);
  std::vector<std::array<Vec3, 3>> triangles;
  for (const auto& t : primitive.triangles) {
    triangles.push_back({FromFloats(primitive.positions[t[0]]),
                         FromFloats(primitive.positions[t[1]]),
                         FromFloats(primitive.positions[t[2]])});
  }
  return triangles;
}

double AreaOf(const std::vector<std::array<Vec3, 3>>& triangles) {
  double area = 0;
  for (const auto& [a, b, c] : triangles) area += Length(Cross(b - a, c - a)) / 2;
  return area;
}

// ---- meshopt

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

// ---- Draco

// A grid of n x n squares over the unit square, with texture coordinates and colours.
std::unique_ptr<draco::Mesh> MakeGrid(int n) {
  draco::TriangleSoupMeshBuilder builder;
  builder.Start(2 * n * n);
  const int position =
      builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  const int color = builder.AddAttribute(draco::GeometryAttribute::COLOR, 4, draco::DT_UINT8);
  const auto add = [&](int face, const std::array<std::array<int, 2>, 3>& corners) {
    std::array<std::array<float, 3>, 3> p;
    std::array<std::array<float, 2>, 3> t;
    std::array<std::array<uint8_t, 4>, 3> c;
    for (int k = 0; k < 3; ++k) {
      const float x = static_cast<float>(corners[k][0]) / n;
      const float y = static_cast<float>(corners[k][1]) / n;
      p[k] = {x, y, 0};
      t[k] = {x, y};
      c[k] = {255, 0, 51, 255};
    }
    const draco::FaceIndex f(face);
    builder.SetAttributeValuesForFace(position, f, p[0].data(), p[1].data(), p[2].data());
    builder.SetAttributeValuesForFace(uv, f, t[0].data(), t[1].data(), t[2].data());
    builder.SetAttributeValuesForFace(color, f, c[0].data(), c[1].data(), c[2].data());
  };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      add(2 * (y * n + x), {{{x, y}, {x + 1, y}, {x + 1, y + 1}}});
      add(2 * (y * n + x) + 1, {{{x, y}, {x + 1, y + 1}, {x, y + 1}}});
    }
  }
  return builder.Finalize();
}

std::string EncodeDraco(const draco::Mesh& mesh, int method) {
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 12);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(mesh, &buffer).ok());
  return {buffer.data(), buffer.size()};
}

// A document whose primitive is `draco` bytes. Its accessors have no data.
GltfDocument DracoDocument(const std::string& draco) {
  GltfDocument document;
  auto& accessors = document.json["accessors"];
  accessors = {{{"componentType", kFloat}, {"type", "VEC3"}, {"count", 4}},
               {{"componentType", kUnsignedShort}, {"type", "SCALAR"}, {"count", 6}},
               {{"componentType", kFloat}, {"type", "VEC2"}, {"count", 4}},
               {{"componentType", 5121}, {"type", "VEC4"}, {"count", 4}, {"normalized", true}}};
  document.Primitive()["attributes"] = {{"POSITION", 0}, {"TEXCOORD_0", 2}, {"COLOR_0", 3}};
  document.Primitive()["extensions"]["KHR_draco_mesh_compression"] = {
      {"bufferView", document.AddViewBytes(draco)},
      {"attributes", {{"POSITION", 0}, {"TEXCOORD_0", 1}, {"COLOR_0", 2}}}};
  document.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  return document;
}

TEST(Draco, BothEncodingsAreDecodedWithTheirAttributes) {
  for (int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    const absl::StatusOr<Scene> scene = DracoDocument(EncodeDraco(*MakeGrid(4), method)).Load();
    ASSERT_TRUE(scene.ok()) << scene.status();
    EXPECT_TRUE(scene->warnings.empty());
    const auto triangles = Triangles(*scene);
    ASSERT_EQ(triangles.size(), 32u);
    EXPECT_NEAR(AreaOf(triangles), 1, 1e-3);
    const Primitive& primitive = scene->meshes[0].primitives[0];
    for (size_t v = 0; v < primitive.positions.size(); ++v) {
      EXPECT_NEAR(primitive.positions[v][0], primitive.uv.at(0)[v][0], 1e-3);
      EXPECT_NEAR(primitive.colors[v][2], 0.2f, 1e-6);
    }
    for (const auto& [a, b, c] : triangles) EXPECT_GT(Cross(b - a, c - a).z, 0) << "the winding";
  }
}

TEST(Draco, ARegularGridIsNotTakenForALie) {
  const std::string draco = EncodeDraco(*MakeGrid(200), draco::MESH_EDGEBREAKER_ENCODING);
  EXPECT_TRUE(DracoDocument(draco).Load().ok());
  EXPECT_LT(80'000.0 / static_cast<double>(draco.size()), 64 / 8.0) << "far from the bound";
}

TEST(Draco, TrianglesAreCountedBeforeTheyAreDecoded) {
  const GltfDocument document =
      DracoDocument(EncodeDraco(*MakeGrid(4), draco::MESH_EDGEBREAKER_ENCODING));
  SceneLimits limits;
  limits.triangles = 31;
  EXPECT_EQ(ReasonOf(document.Load(limits).status()), "SCENE_TOO_LARGE");
  limits.triangles = 32;
  EXPECT_TRUE(document.Load(limits).ok());
}

TEST(Draco, DamagedBytesAreOneLine) {
  for (int method : {draco::MESH_EDGEBREAKER_ENCODING, draco::MESH_SEQUENTIAL_ENCODING}) {
    const std::string good = EncodeDraco(*MakeGrid(3), method);
    for (size_t at = 0; at < good.size(); ++at) {
      for (const char code : {'\x00', '\x7f', '\xff'}) {
        std::string bad = good;
        bad[at] = code;
        const absl::Status status = DracoDocument(bad).Load().status();
        EXPECT_TRUE(status.ok() || !ReasonOf(status).empty()) << at << ": " << status;
      }
      EXPECT_FALSE(DracoDocument(good.substr(0, at)).Load().ok()) << at;
    }
  }
}

TEST(Draco, WhatItsJsonNamesMustBeThere) {
  const std::string good = EncodeDraco(*MakeGrid(1), draco::MESH_EDGEBREAKER_ENCODING);
  for (const char* pointer : {"/bufferView", "/attributes", "/attributes/POSITION"}) {
    for (const nlohmann::json& value : {nlohmann::json(99), nlohmann::json("x")}) {
      GltfDocument document = DracoDocument(good);
      document.Primitive()["extensions"]["KHR_draco_mesh_compression"]
                          [nlohmann::json::json_pointer(pointer)] = value;
      EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID") << pointer << value;
    }
  }
  GltfDocument document = DracoDocument(good);
  document.Primitive()["attributes"]["POSITION"] = 99;
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID");
  document = DracoDocument(good);
  document.json["accessors"][0]["type"] = "MAT4";
  EXPECT_EQ(ReasonOf(document.Load().status()), "SCENE_INVALID");
}

}  // namespace
}  // namespace lambert

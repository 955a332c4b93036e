// Meshes compressed by Draco, made here by its encoder.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

constexpr int kUnsignedShort = 5123, kFloat = 5126;

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

// What is decoded counts, not what the file says beside it.
TEST(Draco, CountsBesideTheDataTakeNoMemory) {
  for (const int accessor : {0, 1, 2, 3}) {
    GltfDocument document =
        DracoDocument(EncodeDraco(*MakeGrid(4), draco::MESH_EDGEBREAKER_ENCODING));
    document.json["accessors"][accessor]["count"] = 1'000'000'000;
    const absl::StatusOr<Scene> scene = document.Load();
    ASSERT_TRUE(scene.ok()) << scene.status();
    EXPECT_EQ(Triangles(*scene).size(), 32u);
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

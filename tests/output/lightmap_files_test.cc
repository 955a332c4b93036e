#include "radiosity/output/lightmap_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <numbers>

#include "radiosity/output/glb.h"
#include "radiosity/output/output_file.h"
#include "radiosity/output/smooth.h"
#include "radiosity/output/texture_image.h"
#include "radiosity/output/texture_light.h"
#include "radiosity/output/write_outputs.h"
#include "radiosity/patch/texture_mean.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/output/known_light.h"
#include "tests/support/read_file.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

using Json = nlohmann::json;

// A floor with a texture of two halves, .2 and .6, and a two-sided wall without.
Scene TexturedScene() {
  Scene scene = SceneMaker()
                    .Quad({}, {0, 0, 1}, {1, 0, 0}, {{1, 1, 1}, {}}, 8, "floor")
                    .Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.3, 0.5}, {}, true}, 4, "wall")
                    .Make();
  Texture texture;
  texture.width = 16;
  texture.height = 16;
  for (int i = 0; i < 256; ++i) {
    const uint8_t code = SrgbByte(i % 16 < 8 ? 0.2 : 0.6);
    texture.rgba.insert(texture.rgba.end(), {code, code, code, 255});
  }
  scene.textures = {texture};
  scene.appearance =
      std::make_shared<const Appearance>(Appearance{R"({"materials": [
          {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorTexture": {"index": 0}}},
          {"pbrMetallicRoughness": {"metallicFactor": 0, "baseColorFactor": [0.5, 0.3, 0.5, 1]}}],
        "textures": [{"source": 0}], "samplers": [], "images": [{"mimeType": "image/jpeg"}]})",
                                                    {EncodeTexture(texture, 1).bytes}});
  scene.materials[0].reflectance_texture.texture = 0;
  Primitive& floor = scene.meshes[0].primitives[0];
  for (const auto& p : floor.positions) floor.uv[0].push_back({p[0], p[2]});
  return scene;
}

RunRecord LightmapRecord(const Scene& scene, const LightmapOptions& options) {
  RunRecord record = RecordOf(PatchesOf(scene), [](Vec3 p) { return Rgb{2 + p.x, 2, 2}; });
  const auto kept = std::make_shared<Scene>(scene);
  if (kept->appearance == nullptr) {
    kept->appearance = std::make_shared<const Appearance>(Appearance{"{}", {}});
  }
  record.scene = kept;
  record.atlas = std::make_shared<const Atlas>(*BuildAtlas(scene, *record.patches, options));
  return record;
}

Scene Reloaded(const std::string& path) {
  SceneBundle bundle;
  bundle.main_name = path;
  bundle.main_bytes = ReadFile(path);
  absl::StatusOr<Scene> scene = LoadGltf(bundle);
  EXPECT_TRUE(scene.ok()) << scene.status();
  return *std::move(scene);
}

// The linear picture at the middle of each triangle of a file of ours: texture times colour.
template <typename Visit>
void ForEachMiddle(const Scene& file, int uv_set, Visit visit) {
  for (const Instance& instance : file.instances) {
    for (const Primitive& primitive : file.meshes[instance.mesh].primitives) {
      const Material& material = file.materials[primitive.material];
      for (const auto& t : primitive.triangles) {
        Vec3 p;
        Rgb color;
        for (uint32_t vertex : t) {
          p = p + instance.world.Point(FromFloats(primitive.positions[vertex])) / 3.0;
          for (int c = 0; c < 3; ++c) {
            color[c] += primitive.colors.empty() ? 1.0 / 3 : primitive.colors[vertex][c] / 3.0;
          }
        }
        const auto corner = [&](int k) {
          return instance.world.Point(FromFloats(primitive.positions[t[k]]));
        };
        const Vec3 normal = Normalized(Cross(corner(1) - corner(0), corner(2) - corner(0)));
        if (material.reflectance_texture.texture >= 0) {
          const Texture& texture = file.textures[material.reflectance_texture.texture];
          const Uv uv = UvAt({0, uv_set}, primitive, t, {1.0 / 3, 1.0 / 3, 1.0 / 3});
          const int x = std::min(static_cast<int>(uv[0] * texture.width), texture.width - 1);
          const int y = std::min(static_cast<int>(uv[1] * texture.height), texture.height - 1);
          const uint8_t* texel = &texture.rgba[4 * (size_t{1} * y * texture.width + x)];
          for (int c = 0; c < 3; ++c) color[c] *= SrgbToLinear(texel[c]);
        }
        visit(p, normal, color);
      }
    }
  }
}

Rgb ExpectedAt(Vec3 p, Vec3 normal, const Exposure& exposure) {
  const bool is_floor = std::fabs(normal.y) > 0.5;
  const double half = p.x < 0.5 ? 0.2 : 0.6;
  const Rgb reflectance = is_floor ? Rgb{half, half, half} : Rgb{0.5, 0.3, 0.5};
  return Develop(reflectance * Rgb{2 + p.x, 2, 2}, exposure);
}

void ExpectClose(Rgb seen, Rgb wanted, double share, Vec3 p) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(seen[c], wanted[c], share * wanted[c]) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(WriteLightmap, ItsFilesShowTheLight) {
  const RunRecord record = LightmapRecord(TexturedScene(), {32});
  const std::string folder = TestFolder();
  ASSERT_TRUE(WriteOutputs(folder, record).ok());
  const Json run = Json::parse(ReadFile(folder + "/run.json"));
  EXPECT_EQ(run["lightmap"]["texels_per_meter"], 32);
  const Exposure exposure{run["picture"]["exposure_per_lm_per_m2"]};
  const Scene lightmapped = Reloaded(folder + "/room.lightmapped.glb");
  int triangles = 0;
  ForEachMiddle(lightmapped, 1, [&](Vec3 p, Vec3 normal, Rgb seen) {
    ++triangles;
    // Smoothed over 1/8 m, so .06 of 2 off where the light is mirrored at an edge; 8 bits.
    ExpectClose(seen, ExpectedAt(p, normal, exposure), 0.06, p);
  });
  EXPECT_EQ(triangles, record.patches->size());
  const Json manifest = Json::parse(ReadFile(folder + "/room.lightmap.json"));
  EXPECT_EQ(manifest["quantity"], "E");
  EXPECT_EQ(manifest["unit"], "lx");
  EXPECT_EQ(manifest["primitives"].size(), 3u);  // the floor, the wall, and its back
  EXPECT_EQ(manifest["pages"][0]["file"], "room.irradiance.exr");
  EXPECT_EQ(manifest["lit"], "room.lit.glb");
  EXPECT_NEAR(manifest["pages"][0]["intensity"], 3, 0.1) << "the brightest irradiance";
  const Scene lit = Reloaded(folder + "/room.lit.glb");
  EXPECT_EQ(lit.textures.size(), 1u) << "the floor's own";
  EXPECT_EQ(lit.materials.at(1).reflectance, (Rgb{0.5, 0.3, 0.5}));
  EXPECT_EQ(PatchesOf(lit).size(), record.patches->size());
  EXPECT_GT(ReadFile(folder + "/room.irradiance.exr").size(), 1000u);
}

// A leaf: a disk of diameter .8 on a square card of two triangles.
bool IsLeaf(double x, double y) { return std::hypot(x - 0.5, y - 0.5) < 0.4; }

Scene MakeLeafOnAWall() {
  Scene scene = SceneMaker()
                    .Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}, 1, "leaf")
                    .Quad({0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}, 1, "wall")
                    .Make();
  Texture texture;
  texture.width = 64;
  texture.height = 64;
  for (int i = 0; i < 64 * 64; ++i) {
    const bool leaf = IsLeaf((i % 64 + 0.5) / 64, (i / 64 + 0.5) / 64);
    texture.rgba.insert(texture.rgba.end(), {255, 255, 255, static_cast<uint8_t>(leaf ? 255 : 0)});
  }
  scene.textures = {texture};
  scene.materials[0].reflectance_texture.texture = 0;
  scene.materials[0].alpha_cutoff = 0.5;
  Primitive& card = scene.meshes[0].primitives[0];
  for (const auto& p : card.positions) card.uv[0].push_back({p[0], p[1]});
  return scene;
}

TEST(WriteLightmap, WhatMasksCutAwayIsNotThere) {
  const RunRecord record = LightmapRecord(MakeLeafOnAWall(), {64});
  ASSERT_EQ(record.patches->size(), 4) << "no triangle is cut by more than half";
  const std::string folder = TestFolder();
  ASSERT_TRUE(WriteOutputs(folder, record).ok());
  const Scene file = Reloaded(folder + "/room.lightmapped.glb");
  int leaves = 0, holes = 0, walls = 0;
  for (const Instance& instance : file.instances) {
    for (const Primitive& primitive : file.meshes[instance.mesh].primitives) {
      const Material& material = file.materials[primitive.material];
      for (const auto& t : primitive.triangles) {
        for (int u = 0; u < 20; ++u) {
          for (int v = 0; u + v < 20; ++v) {
            const Vec3 weights{(u + 0.5) / 21, (v + 0.5) / 21, (20 - u - v) / 21.0};
            const Vec3 p = instance.world.Point({Interpolate(weights, primitive.positions, t, 0),
                                                 Interpolate(weights, primitive.positions, t, 1),
                                                 Interpolate(weights, primitive.positions, t, 2)});
            if (p.z < -0.5) {
              EXPECT_EQ(material.alpha_cutoff, 0) << "the wall has no mask";
              ++walls;
              continue;
            }
            ASSERT_EQ(material.alpha_cutoff, 0.5);
            if (std::fabs(std::hypot(p.x - 0.5, p.y - 0.5) - 0.4) < 1.5 / 64) continue;
            const Texture& texture = file.textures[material.reflectance_texture.texture];
            const Uv uv = UvAt({0, 1}, primitive, t, weights);
            const auto x = static_cast<size_t>(uv[0] * texture.width);
            const auto y = static_cast<size_t>(uv[1] * texture.height);
            const int alpha = texture.rgba[4 * (y * texture.width + x) + 3];
            EXPECT_EQ(alpha, IsLeaf(p.x, p.y) ? 255 : 0) << p.x << " " << p.y;
            ++(IsLeaf(p.x, p.y) ? leaves : holes);
          }
        }
      }
    }
  }
  EXPECT_GT(leaves, 150);
  EXPECT_GT(holes, 100);
  EXPECT_GT(walls, 400);
}

TEST(WriteLightmap, TexelsAreGatheredAtTheirOwnPoints) {
  RunRecord record = LightmapRecord(TexturedScene(), {32});
  const Vec3 origin = record.patches->origin;
  const GatherFunction gather = [origin](const GatherPoints& points) -> absl::StatusOr<Gathered> {
    Gathered light;
    for (const Vec3& p : points.position_m) {
      light.irradiance_lx.push_back({2 + p.x + origin.x, 2, 2});
    }
    light.std_error_lx.resize(points.size());
    return light;
  };
  const std::string folder = TestFolder();
  ASSERT_TRUE(WriteOutputs(folder, record, {}, gather).ok());
  const Json run = Json::parse(ReadFile(folder + "/run.json"));
  const Exposure exposure{run["picture"]["exposure_per_lm_per_m2"]};
  ForEachMiddle(Reloaded(folder + "/room.lightmapped.glb"), 1, [&](Vec3 p, Vec3 normal, Rgb seen) {
    // Half a texel of 1/32 m, and 8 bits.
    ExpectClose(seen, ExpectedAt(p, normal, exposure), 0.02, p);
  });
  const GatherFunction fails = [](const GatherPoints&) { return absl::CancelledError("stopped"); };
  EXPECT_EQ(WriteOutputs(folder, record, {}, fails).code(), absl::StatusCode::kCancelled);
}

TEST(WriteLightmap, PagesAreNumbered) {
  const RunRecord record = LightmapRecord(MakeCornell(), {16, 64});
  ASSERT_GT(record.atlas->pages.size(), 1u);
  const std::string folder = TestFolder();
  ASSERT_TRUE(WriteOutputs(folder, record, {false, false, false, false, false}).ok());
  const Json manifest = Json::parse(ReadFile(folder + "/room.lightmap.json"));
  EXPECT_EQ(manifest["pages"].size(), record.atlas->pages.size());
  for (const Json& page : manifest["pages"]) {
    EXPECT_TRUE(std::filesystem::exists(folder + "/" + page["file"].get<std::string>()));
  }
  EXPECT_EQ(manifest["pages"][1]["file"], "room.irradiance-2.exr");
}

TEST(EncodeGlb, BaseTexturesStaySharp) {
  const RunRecord record = LightmapRecord(TexturedScene(), {32});
  const std::string folder = TestFolder();
  ASSERT_TRUE(WriteOutputs(folder, record).ok());
  const Exposure exposure{
      Json::parse(ReadFile(folder + "/run.json"))["picture"]["exposure_per_lm_per_m2"]};
  const Scene glb = Reloaded(folder + "/room.glb");
  ASSERT_EQ(glb.textures.size(), 1u);
  int textured = 0;
  ForEachMiddle(glb, 0, [&](Vec3 p, Vec3 normal, Rgb seen) {
    textured += std::fabs(normal.y) > 0.5;
    ExpectClose(seen, ExpectedAt(p, normal, exposure), 0.1, p);
  });
  EXPECT_EQ(textured, 128);
}

TEST(EncodeGlb, WhatShinesThroughItsBaseTextureStaysSharpToo) {
  Scene scene = TexturedScene();
  scene.materials[0].luminance = {0.5, 0.5, 0.5};
  scene.materials[0].luminance_texture = scene.materials[0].reflectance_texture;
  const RunRecord record = RecordOf(PatchesOf(scene), [](Vec3) { return Rgb{2, 2, 2}; });
  const Exposure exposure{0.2};
  const std::vector<std::array<Rgb, 3>> light(record.patches->size(),
                                              {Rgb{2, 2, 2}, Rgb{2, 2, 2}, Rgb{2, 2, 2}});
  const std::string path = TestFolder() + "/room.glb";
  const absl::StatusOr<std::string> bytes = EncodeGlb(*record.patches, light, exposure, {}, &scene);
  ASSERT_TRUE(bytes.ok()) << bytes.status();
  ASSERT_TRUE(WriteOutputFile(path, *bytes).ok());
  ForEachMiddle(Reloaded(path), 0, [&](Vec3 p, Vec3 normal, Rgb seen) {
    if (std::fabs(normal.y) < 0.5) return;
    const double texel = p.x < 0.5 ? 0.2 : 0.6, sent = texel * (0.5 * std::numbers::pi + 2);
    ExpectClose(seen, Develop({sent, sent, sent}, exposure), 0.03, p);
  });
  scene.materials[0].luminance_texture.uv_set = 1;
  const TextureLight otherwise(*record.patches, light, exposure, &scene);
  EXPECT_EQ(otherwise.MaterialOf(0), -1);
}

TEST(EncodeGlb, MaterialsOfOneTextureShareIt) {
  Scene scene = TexturedScene();
  scene.materials[1] = scene.materials[0];
  Primitive& wall = scene.meshes[1].primitives[0];
  for (const auto& p : wall.positions) wall.uv[0].push_back({p[0], p[1]});
  const RunRecord record = RecordOf(PatchesOf(scene), [](Vec3) { return Rgb{2, 2, 2}; });
  const std::vector<std::array<Rgb, 3>> light(record.patches->size(),
                                              {Rgb{2, 2, 2}, Rgb{2, 2, 2}, Rgb{2, 2, 2}});
  const std::string path = TestFolder() + "/room.glb";
  const auto bytes = EncodeGlb(*record.patches, light, Exposure{0.2}, {}, &scene);
  ASSERT_TRUE(bytes.ok()) << bytes.status();
  ASSERT_TRUE(WriteOutputFile(path, *bytes).ok());
  const Scene glb = Reloaded(path);
  EXPECT_EQ(glb.materials.size(), 2u);
  EXPECT_EQ(glb.textures.size(), 1u);
}

TEST(EncodeTexture, AGainMakesItBrighter) {
  Texture texture;
  texture.width = texture.height = 1;
  texture.rgba = {SrgbByte(0.1), SrgbByte(0.2), SrgbByte(0.9), 128};
  const ImageBytes as_is = EncodeTexture(texture, 1);
  EXPECT_EQ(as_is.mime_type, "image/png");
  EXPECT_NE(EncodeTexture(texture, 2).bytes, as_is.bytes);
  texture.rgba[3] = 255;
  EXPECT_EQ(EncodeTexture(texture, 1).mime_type, "image/jpeg");
}

TEST(WriteLightmap, TheKhronosValidatorFindsNoError) {
  if (!std::filesystem::exists(LAMBERT_TEST_TOOLS "/node_modules/gltf-validator")) {
    GTEST_SKIP() << "gltf-validator is not installed";
  }
  const std::string folder = TestFolder();
  ASSERT_TRUE(WriteOutputs(folder + "/a", LightmapRecord(TexturedScene(), {32})).ok());
  ASSERT_TRUE(WriteOutputs(folder + "/b", LightmapRecord(MakeCornell(), {16, 64})).ok());
  std::string command = "node " LAMBERT_TEST_TOOLS "/validate_glb.cjs";
  for (const char* part : {"a", "b"}) {
    for (const char* name : {"room.glb", "room.lightmapped.glb", "room.lit.glb"}) {
      command += " '" + folder + "/" + part + "/" + name + "'";
    }
  }
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace lambert

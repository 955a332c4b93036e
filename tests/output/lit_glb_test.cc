// NAME.lit.glb and what it is made of.
#include "radiosity/output/lit_glb.h"

#include <gtest/gtest.h>
#include <stb/stb_image.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "radiosity/output/atlas_nodes.h"
#include "radiosity/output/source_materials.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

using Json = GlbWriter::Json;

// A GLB of ours, taken apart.
struct Parsed {
  Json json;
  std::string binary;

  explicit Parsed(const std::string& glb) {
    uint32_t length = 0;
    std::memcpy(&length, glb.data() + 12, sizeof length);
    json = Json::parse(glb.substr(20, length));
    binary = glb.substr(20 + length + 8);
  }
  std::string ViewBytes(size_t view) const {
    const Json& at = json["bufferViews"][view];
    return binary.substr(at["byteOffset"], at["byteLength"]);
  }
  template <size_t N>
  std::vector<std::array<float, N>> Floats(const Json& accessor) const {
    const std::string bytes = ViewBytes(json["accessors"][accessor.get<size_t>()]["bufferView"]);
    std::vector<std::array<float, N>> values(bytes.size() / sizeof(std::array<float, N>));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
};

Appearance PaintedAppearance() {
  const Json json = {
      {"materials",
       {{{"name", "paint"},
         {"doubleSided", true},
         {"emissiveFactor", {1, 0, 0}},
         {"extras", {{"texCoord", 7}}},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 40}}},
           {"MOZ_hubs_components", {{"index", 3}}}}},
         {"normalTexture", {{"index", 1}, {"texCoord", 1}}},
         {"pbrMetallicRoughness",
          {{"baseColorTexture",
            {{"index", 1},
             {"extensions", {{"KHR_texture_transform", {{"texCoord", 2}, {"scale", {2, 2}}}}}}}},
           {"metallicRoughnessTexture", {{"index", 2}}}}}}}},
      {"textures", {{{"source", 0}}, {{"source", 1}, {"sampler", 1}}, {{"source", 2}}}},
      {"samplers", {Json::object(), {{"wrapS", 33071}}}},
      {"images",
       {{{"mimeType", "image/png"}},
        {{"name", "wood"}, {"mimeType", "image/jpeg"}},
        {{"name", "lost"}, {"mimeType", "image/png"}}}}};
  return {json.dump(), {"unused", "the bytes", ""}};
}

TEST(SourceMaterials, PassesMaterialsAndTheirTexturesOn) {
  const Appearance appearance = PaintedAppearance();
  GlbWriter writer;
  SourceMaterials materials(appearance, writer);
  const Json made = materials.Make(0);
  EXPECT_EQ(made["name"], "paint");
  EXPECT_EQ(made["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"], 40);
  EXPECT_FALSE(made["extensions"].contains("MOZ_hubs_components"))
      << "it may name what is not here";
  EXPECT_EQ(made["extras"]["texCoord"], 7);
  // TEXCOORD_1 is the lightmap's: what lay there is TEXCOORD_2 now.
  EXPECT_EQ(made["normalTexture"], (Json{{"index", 0}, {"texCoord", 2}}));
  const Json& base = made["pbrMetallicRoughness"]["baseColorTexture"];
  EXPECT_EQ(base["index"], 0) << "the same texture, written once";
  EXPECT_EQ(base["extensions"]["KHR_texture_transform"]["texCoord"], 3);
  EXPECT_EQ(base["extensions"]["KHR_texture_transform"]["scale"], (Json{2, 2}));
  const Json& file = writer.root();
  ASSERT_EQ(file["textures"].size(), 2u);
  EXPECT_EQ(file["textures"][0], (Json{{"source", 0}, {"sampler", 0}}));
  EXPECT_EQ(file["textures"][1], Json::object()) << "its image did not come with the scene";
  EXPECT_EQ(file["samplers"], (Json::array({{{"wrapS", 33071}}})));
  ASSERT_EQ(file["images"].size(), 1u);
  EXPECT_EQ(file["images"][0]["mimeType"], "image/jpeg");
  EXPECT_EQ(Parsed(*writer.Finish()).ViewBytes(file["images"][0]["bufferView"]), "the bytes");
  EXPECT_EQ(file["extensionsUsed"],
            (Json{"KHR_materials_emissive_strength", "KHR_texture_transform"}));
  EXPECT_EQ(materials.Make(-1)["pbrMetallicRoughness"]["metallicFactor"], 0);
}

TEST(EncodeLightmapImages, BothHoldIrradianceOverTheIntensity) {
  TexelPage page;
  page.width = 100;
  page.height = 20;
  page.texels.resize(2000);
  TexelValues light(2000, {20, 50, 100});
  for (size_t i = 0; i < 1999; ++i) page.texels[i].patch = 0;
  light[7] = {9000, 1, 0};     // the brightest thousandth
  light[1999] = {1e6f, 0, 0};  // no surface
  const LightmapImages images = EncodeLightmapImages(page, light);
  EXPECT_EQ(images.intensity, 100);
  const auto* const hdr = reinterpret_cast<const unsigned char*>(images.rgbe.data());
  int width = 0, height = 0, channels = 0;
  float* const values = stbi_loadf_from_memory(hdr, static_cast<int>(images.rgbe.size()), &width,
                                               &height, &channels, 3);
  ASSERT_NE(values, nullptr);
  EXPECT_EQ(width, 100);
  EXPECT_EQ(height, 20);
  EXPECT_NEAR(values[0], 0.2, 1.0 / 128);  // 8 bits under the largest channel
  EXPECT_NEAR(values[2], 1, 1.0 / 128);
  EXPECT_NEAR(values[3 * 7], 90, 0.5) << "over 1 where it is brighter";
  stbi_image_free(values);
  const auto* const png = reinterpret_cast<const unsigned char*>(images.png.data());
  unsigned char* const codes = stbi_load_from_memory(png, static_cast<int>(images.png.size()),
                                                     &width, &height, &channels, 3);
  ASSERT_NE(codes, nullptr);
  EXPECT_EQ(codes[0], 51) << "linear";
  EXPECT_EQ(codes[3 * 7], 255) << "cut off";
  stbi_image_free(codes);
  light.assign(2000, {0, 0, 0});
  EXPECT_EQ(EncodeLightmapImages(page, light).intensity, 1);
}

// A two-sided wall, turned over and stretched by its node, with normals, tangents and colours.
TEST(EncodeLitGlb, VerticesKeepWhatEnginesShadeWith) {
  Scene scene = SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{1, 1, 1}, {}, true}).Make();
  Primitive& primitive = scene.meshes[0].primitives[0];
  const size_t count = primitive.positions.size();
  const float half = std::sqrt(0.5f);
  primitive.normals.assign(count, {half, 0, half});
  primitive.tangents.assign(count, {half, 0, -half, 1});
  primitive.colors.assign(count, {0.5, 0.5, 0.5, 1});
  primitive.uv[0].assign(count, {0.25, 0.75});
  primitive.uv[1].assign(count, {0.5, 0.5});
  scene.instances[0].world.x = {-2, 0, 0};  // mirrors
  scene.appearance = std::make_shared<const Appearance>(PaintedAppearance());
  const PatchSet patches = PatchesOf(scene);
  const Atlas atlas = *BuildAtlas(scene, patches, {16});
  const std::vector<AtlasPart> parts = PartsOf(atlas, SidesWithPatches(scene, patches, atlas));
  const std::vector<LightmapImages> pages = {{"an hdr", "a png", 250}};
  const absl::StatusOr<std::string> glb =
      EncodeLitGlb(scene, patches, atlas, parts, pages, {0.01}, {});
  ASSERT_TRUE(glb.ok()) << glb.status();
  const Parsed file(*glb);
  EXPECT_NEAR(file.json["asset"]["extras"]["exposure_per_nit"], 0.01 * 3.14159265, 1e-8);
  ASSERT_EQ(file.json["materials"].size(), 1u) << "one for both sides";
  const Json& material = file.json["materials"][0];
  EXPECT_EQ(material["doubleSided"], false) << "the back is there by itself";
  const Json& lightmap = material["extensions"]["MOZ_lightmap"];
  EXPECT_EQ(lightmap["intensity"], 250);
  EXPECT_EQ(lightmap["texCoord"], 1);
  const Json& texture = file.json["textures"][lightmap["index"].get<size_t>()];
  const auto image_bytes = [&](const Json& image) {
    return file.ViewBytes(file.json["images"][image.get<size_t>()]["bufferView"]);
  };
  EXPECT_EQ(image_bytes(texture["source"]), "a png");
  EXPECT_EQ(image_bytes(texture["extensions"]["MOZ_texture_rgbe"]["source"]), "an hdr");
  const Json& primitives = file.json["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2u);
  for (const int side : {0, 1}) {
    const float sign = side == 0 ? 1 : -1;
    const Json& attributes = primitives[side]["attributes"];
    // (1, 0, 1) stays across the surface that x -> -2 x stretches: (-1, 0, 2) / sqrt(5); the
    // tangent goes with it: (-2, 0, -1) / sqrt(5), and a mirror turns the bitangent round.
    const std::array<float, 3> normal = file.Floats<3>(attributes["NORMAL"])[0];
    EXPECT_NEAR(normal[0], sign * -0.4472136, 1e-6);
    EXPECT_NEAR(normal[2], sign * 0.8944272, 1e-6);
    const std::array<float, 4> tangent = file.Floats<4>(attributes["TANGENT"])[0];
    EXPECT_NEAR(tangent[0], sign * -0.8944272, 1e-6);
    EXPECT_NEAR(tangent[2], sign * -0.4472136, 1e-6);
    EXPECT_EQ(tangent[3], -sign);
    EXPECT_EQ(file.Floats<4>(attributes["COLOR_0"])[0], primitive.colors[0]);
    EXPECT_EQ(file.Floats<2>(attributes["TEXCOORD_0"])[0], primitive.uv[0][0]);
    EXPECT_EQ(file.Floats<2>(attributes["TEXCOORD_2"])[0], primitive.uv[1][0]);
    EXPECT_EQ(file.Floats<2>(attributes["TEXCOORD_1"]), parts[side].uv);
  }
}

}  // namespace
}  // namespace lambert

// A file that has a little of everything, with each value of its JSON in turn replaced by one that
// lies.
#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "radiosity/core/philox.h"
#include "radiosity/patch/build_patches.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

using nlohmann::json;

GltfDocument EverythingDocument() {
  GltfDocument document;
  json& gltf = document.json;
  const int texture = document.AddTexture(MakePng(2, 1, std::string(8, '\x70')));
  gltf["samplers"] = {{{"wrapS", 33648}, {"wrapT", 33071}}};
  gltf["textures"][0]["sampler"] = 0;
  json& material = document.Material();
  material["alphaMode"] = "MASK";
  material["alphaCutoff"] = 0.1;
  material["doubleSided"] = true;
  material["pbrMetallicRoughness"]["baseColorTexture"] = {
      {"index", texture},
      {"texCoord", 0},
      {"extensions",
       {{"KHR_texture_transform", {{"offset", {0, 1}}, {"scale", {2, 2}}, {"rotation", 1}}}}}};
  material["emissiveTexture"] = {{"index", texture}};
  material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 10;
  json& primitive = document.Primitive();
  primitive["mode"] = 4;
  primitive["attributes"]["NORMAL"] =
      document.AddAccessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1}, 5126, "VEC3", 3);
  primitive["attributes"]["COLOR_0"] = document.AddAccessor<uint8_t>(
      {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255}, 5121, "VEC4", 3);
  gltf["accessors"].back()["normalized"] = true;
  primitive["targets"] = {
      {{"POSITION", document.AddAccessor<float>(std::vector<float>(9, 0.5f), 5126, "VEC3", 3)}}};
  gltf["meshes"][0]["weights"] = {0.5};
  gltf["accessors"][0]["sparse"] = {
      {"count", 1},
      {"indices", {{"bufferView", document.AddView<uint8_t>({2})}, {"componentType", 5121}}},
      {"values", {{"bufferView", document.AddView<float>({0, 2, 0})}}}};
  gltf["bufferViews"][0]["byteStride"] = 12;
  gltf["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
  gltf["extensions"]["KHR_lights_punctual"]["lights"] = {
      {{"type", "point"}, {"intensity", 5}, {"color", {1, 1, 0.5}}},
      {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.1}, {"outerConeAngle", 0.5}}}}};
  document.Node()["translation"] = {0, 0, 1};
  document.Node()["rotation"] = {0, 0, 0, 1};
  document.Node()["scale"] = {1, 2, 1};
  gltf["skins"] = {{{"joints", {1}}}};
  gltf["nodes"].push_back({{"camera", 0}, {"children", {2}}});
  gltf["nodes"].push_back({{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 3, 1}},
                           {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  gltf["scenes"][0]["nodes"] = {0, 1};
  return document;
}

const std::vector<json>& Lies() {
  static const auto& lies = *new std::vector<json>{-1,
                                                   0,
                                                   1,
                                                   2,
                                                   7,
                                                   255,
                                                   1e9,
                                                   2147483648.0,
                                                   -2147483649.0,
                                                   uint64_t(1) << 63,
                                                   1e300,
                                                   -1e300,
                                                   1e-300,
                                                   0.5,
                                                   1e39,
                                                   true,
                                                   nullptr,
                                                   "",
                                                   "VEC4",
                                                   "../x",
                                                   json::array(),
                                                   json::object(),
                                                   {0},
                                                   {-1},
                                                   {1e300, 1e300, 1e300}};
  return lies;
}

// Loads a file and builds its patches, in small limits: usable patches, or one line that says why
// not.
void ExpectGoodEnd(const GltfDocument& document, const std::string& what) {
  SCOPED_TRACE(what);
  const SceneLimits limits{
      .bytes = 1 << 20, .triangles = 10'000, .image_pixels = 1 << 16, .total_pixels = 1 << 18};
  absl::StatusOr<Scene> scene = document.Load(limits);
  absl::Status status = scene.status();
  if (scene.ok()) {
    PatchOptions options;
    options.max_patches = 10'000;
    const absl::StatusOr<PatchSet> patches = BuildPatches(*scene, options);
    status = patches.status();
    // The codec refuses whatever is not finite or out of range.
    EXPECT_TRUE(!patches.ok() || DecodePatchSet(EncodePatchSet(*patches)).ok());
  }
  if (status.ok()) return;
  EXPECT_TRUE(GetErrorDetail(status).has_value()) << status;
  EXPECT_EQ(status.message().find('\n'), std::string::npos) << status;
}

std::vector<json::json_pointer> Places(const GltfDocument& document) {
  std::vector<json::json_pointer> places;
  const json flat = document.json.flatten();
  for (const auto& [path, value] : flat.items()) {
    for (json::json_pointer place(path); !place.empty(); place = place.parent_pointer()) {
      if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
    }
  }
  return places;
}

TEST(HostileMutations, TheFileItselfLoads) {
  const absl::StatusOr<Scene> scene = EverythingDocument().Load();
  ASSERT_TRUE(scene.ok()) << scene.status();
  EXPECT_TRUE(BuildPatches(*scene, {}).ok());
}

TEST(HostileMutations, EveryValueMayLie) {
  const GltfDocument document = EverythingDocument();
  for (const json::json_pointer& place : Places(document)) {
    for (const json& lie : Lies()) {
      GltfDocument lying = document;
      lying.json[place] = lie;
      ExpectGoodEnd(lying, place.to_string() + " = " + lie.dump());
    }
    GltfDocument without = document;
    json& parent = without.json[place.parent_pointer()];
    if (parent.is_object()) {
      parent.erase(place.back());
    } else {
      parent.erase(std::stoul(place.back()));
    }
    ExpectGoodEnd(without, "without " + place.to_string());
  }
}

TEST(HostileMutations, ThreeValuesMayLieAtOnce) {
  const GltfDocument document = EverythingDocument();
  const std::vector<json::json_pointer> places = Places(document);
  for (uint32_t k = 0; k < 5000; ++k) {
    GltfDocument lying = document;
    std::string what;
    for (uint32_t lie = 0; lie < 3; ++lie) {
      const auto draw = Philox({k, lie, 0, 0}, {1, 2});
      const json::json_pointer& place = places[draw[0] % places.size()];
      if (!lying.json.contains(place)) continue;
      lying.json[place] = Lies()[draw[1] % Lies().size()];
      what += place.to_string() + " = " + lying.json[place].dump() + "; ";
    }
    ExpectGoodEnd(lying, what);
  }
}

}  // namespace
}  // namespace lambert

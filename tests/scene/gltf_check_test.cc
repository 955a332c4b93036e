// What glTF 2.0 says of its JSON: each fault is refused where it stands.
#include "radiosity/scene/gltf_check.h"

#include <gtest/gtest.h>

#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_container.h"
#include "tests/scene/gltf_document.h"

namespace lambert {
namespace {

using Edit = std::function<void(GltfDocument&)>;

// What CheckGltf says of a document after `edit`; "" where it is right.
std::string Fault(const Edit& edit, std::vector<Warning>* warnings = nullptr) {
  GltfDocument document;
  edit(document);
  std::vector<Warning> unused;
  const absl::Status status =
      CheckGltf(document.json.dump(), warnings != nullptr ? warnings : &unused);
  EXPECT_TRUE(status.ok() || ReasonOf(status) == "SCENE_INVALID") << status;
  return std::string(status.message());
}

void ExpectFault(const std::string& text, const Edit& edit) {
  EXPECT_NE(Fault(edit).find(text), std::string::npos) << text << ", not: " << Fault(edit);
}

std::vector<std::string> Reasons(const std::vector<Warning>& warnings) {
  std::vector<std::string> reasons;
  for (const Warning& warning : warnings) reasons.push_back(warning.reason);
  return reasons;
}

TEST(CheckGltf, AGoodFileIsRight) {
  EXPECT_EQ(Fault([](GltfDocument&) {}), "");
  EXPECT_EQ(Fault([](GltfDocument& d) { d.json["accessors"][0]["count"] = 3.0; }), "");
  EXPECT_EQ(Fault([](GltfDocument& d) { d.json["extras"] = {{"extensions", 1}}; }), "");
  EXPECT_EQ(Fault([](GltfDocument& d) { d.json["asset"]["version"] = "1.0"; }), "");
}

TEST(CheckGltf, PropertiesHaveTheirTypesAndRanges) {
  ExpectFault("asset: it is missing", [](GltfDocument& d) { d.json.erase("asset"); });
  ExpectFault("asset: it is not an object", [](GltfDocument& d) { d.json["asset"] = 7; });
  ExpectFault("asset, version: it is not a string",
              [](GltfDocument& d) { d.json["asset"]["version"] = 2.0; });
  ExpectFault("cameras: it is empty",
              [](GltfDocument& d) { d.json["cameras"] = nlohmann::json::array(); });
  ExpectFault("skins: it is not an array", [](GltfDocument& d) { d.json["skins"] = "none"; });
  ExpectFault("material 0, emissiveFactor: 2 is over 1", [](GltfDocument& d) {
    d.Material()["emissiveFactor"] = {0, 2, 0};
  });
  ExpectFault("material 0, emissiveFactor: its length is 2, not 3", [](GltfDocument& d) {
    d.Material()["emissiveFactor"] = {0, 1};
  });
  ExpectFault("doubleSided: it is neither",
              [](GltfDocument& d) { d.Material()["doubleSided"] = 1; });
  ExpectFault("accessor 0, count: 0 is under 1",
              [](GltfDocument& d) { d.json["accessors"][0]["count"] = 0; });
  ExpectFault("accessor 0, count: 2.5 is not a whole number",
              [](GltfDocument& d) { d.json["accessors"][0]["count"] = 2.5; });
  ExpectFault("accessor 0, count: it is not a number",
              [](GltfDocument& d) { d.json["accessors"][0]["count"] = "3"; });
  ExpectFault("attributes: it is empty",
              [](GltfDocument& d) { d.Primitive()["attributes"] = nlohmann::json::object(); });
  ExpectFault("targets: it is not an object",
              [](GltfDocument& d) { d.Primitive()["targets"] = {1}; });
}

TEST(CheckGltf, IndicesNameWhatIsThereAlsoWhereNothingIsShown) {
  ExpectFault("texture 0 does not exist",
              [](GltfDocument& d) { d.Material()["normalTexture"]["index"] = 0; });
  ExpectFault("skin 0, joints: node 9 does not exist", [](GltfDocument& d) {
    d.json["skins"] = {{{"joints", {9}}}};
  });
  ExpectFault("light 1 does not exist", [](GltfDocument& d) {
    d.json["extensionsUsed"] = {"KHR_lights_punctual"};
    d.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    d.Node()["extensions"]["KHR_lights_punctual"]["light"] = 1;
  });
  ExpectFault("light 0 does not exist", [](GltfDocument& d) {
    d.json["extensionsUsed"] = {"KHR_lights_punctual"};
    d.Node()["extensions"]["KHR_lights_punctual"]["light"] = 0;
  });
  ExpectFault("its sampler 1 does not exist", [](GltfDocument& d) {
    d.json["animations"] = {{{"samplers", {{{"input", 0}, {"output", 0}}}},
                             {"channels", {{{"sampler", 1}, {"target", {{"path", "scale"}}}}}}}};
  });
}

TEST(CheckGltf, PropertiesFitTogether) {
  ExpectFault("runs past the", [](GltfDocument& d) { d.json["buffers"][0]["byteLength"] = 40; });
  ExpectFault("no bufferView", [](GltfDocument& d) {
    d.json["accessors"][0].erase("bufferView");
    d.json["accessors"][0]["byteOffset"] = 4;
  });
  ExpectFault("normalized", [](GltfDocument& d) { d.json["accessors"][0]["normalized"] = true; });
  ExpectFault("a matrix and a scale", [](GltfDocument& d) {
    d.Node()["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    d.Node()["scale"] = {1, 1, 1};
  });
  ExpectFault("length 0.5, not 1", [](GltfDocument& d) { d.Node()["rotation"] = {0, 0, 0, 0.5}; });
  EXPECT_EQ(Fault([](GltfDocument& d) { d.Node()["rotation"] = {0, 0, 0, 0.995}; }), "");
  ExpectFault("weights, but no mesh", [](GltfDocument& d) {
    d.json["nodes"].push_back({{"weights", {1}}});
  });
  ExpectFault("does not suit its lens", [](GltfDocument& d) {
    d.json["cameras"] = {{{"type", "perspective"}}};
  });
  ExpectFault("zfar", [](GltfDocument& d) {
    d.json["cameras"] = {
        {{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 2}, {"zfar", 2}}}}};
  });
  ExpectFault("xmag", [](GltfDocument& d) {
    d.json["cameras"] = {{{"type", "orthographic"},
                          {"orthographic", {{"xmag", 0}, {"ymag", 1}, {"znear", 1}, {"zfar", 2}}}}};
  });
  ExpectFault("no attribute \"WEIGHT\"",
              [](GltfDocument& d) { d.Primitive()["attributes"]["WEIGHT"] = 0; });
  EXPECT_EQ(Fault([](GltfDocument& d) { d.Primitive()["attributes"]["_MINE"] = 0; }), "");
  ExpectFault("a target moves NORMAL", [](GltfDocument& d) {
    d.Primitive()["targets"] = {{{"NORMAL", 0}}};
  });
  ExpectFault("2 weights for 1 targets", [](GltfDocument& d) {
    d.Primitive()["targets"] = {{{"POSITION", 0}}};
    d.json["meshes"][0]["weights"] = {0, 1};
  });
  ExpectFault("different numbers of targets", [](GltfDocument& d) {
    d.json["meshes"][0]["primitives"].push_back(d.Primitive());
    d.Primitive()["targets"] = {{{"POSITION", 0}}};
  });
}

TEST(CheckGltf, LightsAreOfTheirKind) {
  const auto light = [](const nlohmann::json& light) {
    return [light](GltfDocument& d) {
      d.json["extensionsUsed"] = {"KHR_lights_punctual"};
      d.json["extensions"]["KHR_lights_punctual"]["lights"] = {light};
    };
  };
  EXPECT_EQ(Fault(light({{"type", "spot"}, {"spot", {{"outerConeAngle", 1}}}})), "");
  ExpectFault("\"laser\" does not exist", light({{"type", "laser"}}));
  ExpectFault("needs spot", light({{"type", "spot"}}));
  ExpectFault("only a spot light", light({{"type", "point"}, {"spot", nlohmann::json::object()}}));
  ExpectFault("innerConeAngle is not under",
              light({{"type", "spot"}, {"spot", {{"innerConeAngle", 0.9}}}}));
  ExpectFault("intensity: -1 is under 0", light({{"type", "point"}, {"intensity", -1}}));
}

TEST(CheckGltf, ExtensionsAreDeclaredAndStandWhereTheyMay) {
  ExpectFault("KHR_materials_unlit is not named in extensionsUsed", [](GltfDocument& d) {
    d.Material()["extensions"]["KHR_materials_unlit"] = nlohmann::json::object();
  });
  ExpectFault("KHR_materials_unlit has no place here", [](GltfDocument& d) {
    d.json["extensionsUsed"] = {"KHR_materials_unlit"};
    d.Node()["extensions"]["KHR_materials_unlit"] = nlohmann::json::object();
  });
  ExpectFault("extensions: it is not an object",
              [](GltfDocument& d) { d.Node()["extensions"] = 1; });
  EXPECT_EQ(Fault([](GltfDocument& d) {
              d.json["extensionsUsed"] = {"ACME_mirrors"};
              d.Node()["extensions"]["ACME_mirrors"] = nlohmann::json::object();
            }),
            "");
}

TEST(CheckGltf, WhatIsWrongButClearIsWarnedOf) {
  std::vector<Warning> warnings;
  EXPECT_EQ(
      Fault([](GltfDocument& d) { d.json["extensionsRequired"] = {"ACME_mirrors"}; }, &warnings),
      "");
  const std::string text = GltfDocument().json.dump();
  EXPECT_TRUE(CheckGltf("\xef\xbb\xbf" + text, &warnings).ok());
  EXPECT_TRUE(CheckGltf("{\"scene\":7," + text.substr(1), &warnings).ok());
  EXPECT_EQ(Reasons(warnings), (std::vector<std::string>{"EXTENSION_REQUIRED_NOT_USED", "JSON_BOM",
                                                         "JSON_DUPLICATE_KEY"}));
}

TEST(CheckContainer, ChunksEndWithTheFileAndAreOfDifferentTypes) {
  const std::string glb = GltfDocument().Glb();
  EXPECT_TRUE(CheckContainer(glb)->empty());
  EXPECT_TRUE(CheckContainer(GltfDocument().json.dump())->empty());
  EXPECT_EQ(Reasons(*CheckContainer(glb + "after")), std::vector<std::string>{"GLB_TRAILING_DATA"});
  std::string shorter = glb, twice = glb + std::string("\4\0\0\0BIN\0data", 12);
  shorter[8] = static_cast<char>(shorter[8] - 4);
  EXPECT_FALSE(CheckContainer(shorter).ok());
  twice[8] = static_cast<char>(twice[8] + 12);
  EXPECT_FALSE(CheckContainer(twice).ok());
  std::string unaligned = glb + std::string("\1\0\0\0more!", 9);
  unaligned[8] = static_cast<char>(unaligned[8] + 9);
  EXPECT_EQ(Reasons(*CheckContainer(unaligned)), std::vector<std::string>{"GLB_CHUNK_ALIGNMENT"});
  std::string stump = glb + "four";
  stump[8] = static_cast<char>(stump[8] + 4);
  EXPECT_FALSE(CheckContainer(stump).ok());
}

}  // namespace
}  // namespace lambert

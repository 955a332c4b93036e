#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

using Json = nlohmann::json;

Json ToJson(Rgb a) { return {a.r, a.g, a.b}; }

Json ToMatrix(const Transform& t) {
  Json matrix = Json::array();
  for (const auto& [column, w] : {std::pair{t.x, 0.0}, std::pair{t.y, 0.0}, std::pair{t.z, 0.0},
                                  std::pair{t.translation, 1.0}}) {
    for (double x : {column.x, column.y, column.z, w}) matrix.push_back(x);
  }
  return matrix;
}

// Appends `data` to the binary chunk as a buffer view of its own; returns the view's index.
template <typename T>
size_t AddView(const std::vector<T>& data, Json* gltf, std::string* chunk) {
  (*gltf)["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", chunk->size()}, {"byteLength", data.size() * sizeof(T)}});
  chunk->append(reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T));
  return (*gltf)["bufferViews"].size() - 1;
}

Json ToJson(const Primitive& primitive, Json* gltf, std::string* chunk) {
  Json& accessors = (*gltf)["accessors"];
  std::array<float, 3> low = primitive.positions[0], high = low;
  for (const auto& p : primitive.positions) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  }
  const size_t positions = AddView(primitive.positions, gltf, chunk);
  accessors.push_back({{"bufferView", positions},
                       {"componentType", 5126},
                       {"type", "VEC3"},
                       {"count", primitive.positions.size()},
                       {"min", low},
                       {"max", high}});
  const size_t triangles = AddView(primitive.triangles, gltf, chunk);
  accessors.push_back({{"bufferView", triangles},
                       {"componentType", 5125},
                       {"type", "SCALAR"},
                       {"count", primitive.triangles.size() * 3}});
  Json json = {{"attributes", {{"POSITION", accessors.size() - 2}}},
               {"indices", accessors.size() - 1}};
  if (primitive.material >= 0) json["material"] = primitive.material;
  return json;
}

Json ToJson(const Material& material) {
  Json rho = ToJson(material.reflectance);
  rho.push_back(1);
  Json json = {{"name", material.name},
               {"doubleSided", material.two_sided},
               {"alphaMode", material.blend ? "BLEND" : "OPAQUE"},
               {"pbrMetallicRoughness", {{"baseColorFactor", rho}, {"metallicFactor", 0}}}};
  const Rgb l = material.luminance;
  const double strength = std::max({l.r, l.g, l.b});
  if (strength > 0) {
    json["emissiveFactor"] = ToJson(l / strength);
    json["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
  }
  return json;
}

// Point, spot and directional lights shine along -z of their node.
Json ToJson(const Light& light) {
  const Rgb i = light.strength;
  const double brightest = std::max({i.r, i.g, i.b});
  Json json = {{"type", "point"}, {"color", ToJson(i / brightest)}, {"intensity", brightest}};
  if (light.kind == Light::Kind::kDistant) {
    json["type"] = "directional";
  } else if (light.cos_outer > -1) {
    json["type"] = "spot";
    json["spot"] = {{"innerConeAngle", std::acos(light.cos_inner)},
                    {"outerConeAngle", std::acos(light.cos_outer)}};
  }
  return json;
}

// A node for every camera and light, after those of the instances.
void AddCamerasAndLights(const Scene& scene, Json* gltf) {
  for (const Camera& camera : scene.cameras) {
    const Json lens = {{"yfov", camera.yfov_rad}, {"aspectRatio", camera.aspect}, {"znear", 0.01}};
    (*gltf)["cameras"].push_back({{"type", "perspective"}, {"perspective", lens}});
    (*gltf)["nodes"].push_back({{"name", camera.name},
                                {"matrix", ToMatrix(camera.world)},
                                {"camera", (*gltf)["cameras"].size() - 1}});
  }
  for (const Light& light : scene.lights) {
    Json& lights = (*gltf)["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(ToJson(light));
    Json node = {{"name", light.name},
                 {"matrix", ToMatrix({light.x, -light.y, -light.z, light.position})}};
    node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    (*gltf)["nodes"].push_back(node);
    (*gltf)["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_emissive_strength"};
  }
}

void AppendChunk(uint32_t type, std::string data, char padding, std::string* glb) {
  data.resize((data.size() + 3) / 4 * 4, padding);
  const uint32_t head[2] = {static_cast<uint32_t>(data.size()), type};
  glb->append(reinterpret_cast<const char*>(head), sizeof head);
  *glb += data;
}

}  // namespace

std::string ToGlb(const Scene& scene) {
  Json gltf = {{"asset", {{"version", "2.0"}}},
               {"extensionsUsed", {"KHR_materials_emissive_strength"}}};
  std::string chunk;
  for (const Material& material : scene.materials) gltf["materials"].push_back(ToJson(material));
  for (const Mesh& mesh : scene.meshes) {
    Json primitives = Json::array();
    for (const Primitive& primitive : mesh.primitives) {
      primitives.push_back(ToJson(primitive, &gltf, &chunk));
    }
    gltf["meshes"].push_back({{"name", mesh.name}, {"primitives", primitives}});
  }
  for (const std::string& name : scene.node_names) gltf["nodes"].push_back({{"name", name}});
  for (const Instance& instance : scene.instances) {
    gltf["nodes"][instance.node]["mesh"] = instance.mesh;
    gltf["nodes"][instance.node]["matrix"] = ToMatrix(instance.world);
  }
  AddCamerasAndLights(scene, &gltf);
  for (size_t i = 0; i < gltf["nodes"].size(); ++i) gltf["scenes"][0]["nodes"].push_back(i);
  gltf["scene"] = 0;
  gltf["buffers"].push_back({{"byteLength", chunk.size()}});
  std::string body;
  AppendChunk(0x4e4f534a, gltf.dump(), ' ', &body);
  AppendChunk(0x004e4942, chunk, '\0', &body);
  const uint32_t head[3] = {0x46546c67, 2, static_cast<uint32_t>(body.size() + 12)};
  return std::string(reinterpret_cast<const char*>(head), sizeof head) + body;
}

}  // namespace lambert

#include "examples/glb_writer.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

namespace lambert::examples {
namespace {

using Json = nlohmann::ordered_json;
using Corner = std::array<float, 3>;

// Numbers of the glTF 2.0 specification.
constexpr int kFloat = 5126, kUnsignedShort = 5123;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr uint32_t kGlbMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

struct IndexedMesh {
  std::vector<Corner> corners;
  std::vector<uint16_t> indices;
};

// Requires: at most 65,535 different corners.
IndexedMesh Index(const std::vector<std::array<Vec3, 3>>& triangles) {
  IndexedMesh mesh;
  std::map<Corner, uint16_t> known;
  for (const auto& triangle : triangles) {
    for (Vec3 p : triangle) {
      const Corner corner{static_cast<float>(p.x), static_cast<float>(p.y),
                          static_cast<float>(p.z)};
      const auto [at, is_new] = known.try_emplace(corner, static_cast<uint16_t>(known.size()));
      if (is_new) mesh.corners.push_back(corner);
      mesh.indices.push_back(at->second);
    }
  }
  return mesh;
}

void PadTo4(std::string& bytes, char with) { bytes.append((4 - bytes.size() % 4) % 4, with); }

void AppendUint32(std::string& bytes, uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes.push_back(static_cast<char>(value >> (8 * i) & 255));
}

// Appends `size` bytes as a buffer view and returns its index.
size_t AppendView(const void* data, size_t size, int target, std::string& binary, Json& gltf) {
  PadTo4(binary, '\0');
  gltf["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", size}, {"target", target}});
  binary.append(static_cast<const char*>(data), size);
  return gltf["bufferViews"].size() - 1;
}

// Appends an object's node, mesh, accessors and views.
void AppendObject(const GlbObject& object, std::string& binary, Json& gltf) {
  const IndexedMesh mesh = Index(object.triangles);
  Corner lo = mesh.corners[0], hi = lo;
  for (const Corner& corner : mesh.corners) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], corner[axis]);
      hi[axis] = std::max(hi[axis], corner[axis]);
    }
  }
  const size_t positions = gltf["accessors"].size();
  gltf["accessors"].push_back(
      {{"bufferView", AppendView(mesh.corners.data(), mesh.corners.size() * sizeof(Corner),
                                 kArrayBuffer, binary, gltf)},
       {"componentType", kFloat},
       {"count", mesh.corners.size()},
       {"type", "VEC3"},
       {"min", lo},
       {"max", hi}});
  gltf["accessors"].push_back(
      {{"bufferView", AppendView(mesh.indices.data(), mesh.indices.size() * sizeof(uint16_t),
                                 kElementArrayBuffer, binary, gltf)},
       {"componentType", kUnsignedShort},
       {"count", mesh.indices.size()},
       {"type", "SCALAR"}});
  const Json primitive = {{"attributes", {{"POSITION", positions}}},
                          {"indices", positions + 1},
                          {"material", object.material}};
  gltf["meshes"].push_back({{"name", object.name}, {"primitives", Json::array({primitive})}});
  gltf["nodes"].push_back({{"name", object.name}, {"mesh", gltf["meshes"].size() - 1}});
}

Json Factors(Rgb rgb) { return Json::array({rgb.r, rgb.g, rgb.b}); }

// emissiveFactor ends at 1, so the largest channel becomes the strength.
Json EncodeMaterial(const GlbMaterial& material) {
  Json base = Factors(material.reflectance);
  base.push_back(1);
  Json json = {{"name", material.name},
               {"pbrMetallicRoughness",
                {{"baseColorFactor", base}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
  const Rgb luminance_nit = material.luminance_nit;
  const double strength_nit = std::max({luminance_nit.r, luminance_nit.g, luminance_nit.b});
  if (strength_nit > 0) {
    json["emissiveFactor"] = Factors(luminance_nit / strength_nit);
    json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength_nit}};
  }
  return json;
}

// The camera looks along -z of its node.
void AppendCamera(const GlbCamera& camera, Json& gltf) {
  const Vec3 z = Normalized(camera.eye - camera.target);
  const Vec3 x = Normalized(Cross({0, 1, 0}, z));
  const Vec3 y = Cross(z, x);
  const Vec3 eye = camera.eye;
  gltf["cameras"].push_back({{"name", camera.name},
                             {"type", "perspective"},
                             {"perspective",
                              {{"yfov", camera.yfov_rad},
                               {"aspectRatio", camera.aspect},
                               {"znear", 0.01},
                               {"zfar", 100}}}});
  gltf["nodes"].push_back(
      {{"name", camera.name},
       {"camera", 0},
       {"matrix", {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, eye.x, eye.y, eye.z, 1}}});
}

}  // namespace

std::string EncodeGlb(const GlbScene& scene) {
  Json gltf = {{"asset",
                {{"version", "2.0"},
                 {"generator", "Lambert examples/make_room"},
                 {"copyright", scene.copyright}}},
               {"extensionsUsed", {"KHR_materials_emissive_strength"}},
               {"scene", 0}};
  for (const char* list : {"accessors", "bufferViews", "nodes"}) gltf[list] = Json::array();
  std::string binary;
  for (const GlbMaterial& material : scene.materials) {
    gltf["materials"].push_back(EncodeMaterial(material));
  }
  for (const GlbObject& object : scene.objects) {
    if (!object.triangles.empty()) AppendObject(object, binary, gltf);
  }
  AppendCamera(scene.camera, gltf);
  Json roots = Json::array();
  for (size_t i = 0; i < gltf["nodes"].size(); ++i) roots.push_back(i);
  gltf["scenes"] = Json::array({{{"name", scene.name}, {"nodes", roots}}});
  PadTo4(binary, '\0');
  gltf["buffers"] = Json::array({{{"byteLength", binary.size()}}});

  std::string json = gltf.dump();
  PadTo4(json, ' ');
  std::string file;
  AppendUint32(file, kGlbMagic);
  AppendUint32(file, 2);
  AppendUint32(file, static_cast<uint32_t>(12 + 8 + json.size() + 8 + binary.size()));
  AppendUint32(file, static_cast<uint32_t>(json.size()));
  AppendUint32(file, kJsonChunk);
  file += json;
  AppendUint32(file, static_cast<uint32_t>(binary.size()));
  AppendUint32(file, kBinaryChunk);
  file += binary;
  return file;
}

}  // namespace lambert::examples

// A glTF file under construction: JSON that a test edits, and the binary data that it names.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/scene/load_gltf.h"

namespace lambert {

class GltfDocument {
 public:
  // One node that shows one triangle (0 0 0, 1 0 0, 0 1 0) with uint16 indices 0 1 2 and a material
  // that reflects .5 and emits 1 nit. Accessors: 0 positions, 1 indices.
  GltfDocument();

  nlohmann::json json;

  nlohmann::json& Primitive() { return json["meshes"][0]["primitives"][0]; }
  nlohmann::json& Material() { return json["materials"][0]; }
  nlohmann::json& Node() { return json["nodes"][0]; }

  // Adds a buffer view over `data`; returns its index.
  template <typename T>
  int AddView(const std::vector<T>& data) {
    return AddViewBytes({reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T)});
  }
  int AddViewBytes(const std::string& bytes);
  // Adds an accessor of all of `data`; returns its index.
  template <typename T>
  int AddAccessor(const std::vector<T>& data, int component_type, const std::string& type,
                  size_t count) {
    json["accessors"].push_back({{"bufferView", AddView(data)},
                                 {"componentType", component_type},
                                 {"type", type},
                                 {"count", count}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  // Adds the image, a texture of it and TEXCOORD_0 over the triangle; returns the texture's index.
  int AddTexture(const std::string& image_bytes);

  // With all extensions that the JSON holds in extensionsUsed.
  std::string Glb() const;
  absl::StatusOr<Scene> Load(const SceneLimits& limits = {}) const;

 private:
  std::string binary_;
};

// The corners of every triangle of the first mesh, in the order of the file, and their area.
std::vector<std::array<Vec3, 3>> Triangles(const Scene& scene);
double AreaOf(const std::vector<std::array<Vec3, 3>>& triangles);

// An uncompressed RGBA PNG of one colour per pixel; `codes`: width * height * 4 values.
std::string MakePng(uint32_t width, uint32_t height, const std::string& codes);

}  // namespace lambert

#include "tests/scene/gltf_document.h"

#include <cstring>
#include <set>

namespace lambert {
namespace {

void AppendU32(uint32_t value, std::string* bytes) {
  bytes->append(reinterpret_cast<const char*>(&value), sizeof value);
}

void AppendChunk(const char* type, std::string data, char padding, std::string* glb) {
  data.resize((data.size() + 3) / 4 * 4, padding);
  AppendU32(static_cast<uint32_t>(data.size()), glb);
  glb->append(type, 4);
  *glb += data;
}

void AppendBigEndian(uint32_t value, int bytes, std::string* out) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    out->push_back(static_cast<char>(value >> shift & 0xff));
  }
}

uint32_t Crc32(const std::string& data) {
  uint32_t crc = 0xffffffff;
  for (unsigned char c : data) {
    crc ^= c;
    for (int k = 0; k < 8; ++k) crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
  }
  return ~crc;
}

void AppendPngChunk(const std::string& type, const std::string& data, std::string* png) {
  AppendBigEndian(static_cast<uint32_t>(data.size()), 4, png);
  *png += type + data;
  AppendBigEndian(Crc32(type + data), 4, png);
}

// zlib with one stored block. Requires: fewer than 65536 bytes.
std::string Stored(const std::string& data) {
  const uint16_t size = static_cast<uint16_t>(data.size());
  std::string zlib = {0x78,
                      0x01,
                      0x01,
                      static_cast<char>(size & 0xff),
                      static_cast<char>(size >> 8),
                      static_cast<char>(~size & 0xff),
                      static_cast<char>(~size >> 8 & 0xff)};
  uint32_t a = 1, b = 0;
  for (unsigned char c : data) {
    a = (a + c) % 65521;
    b = (b + a) % 65521;
  }
  zlib += data;
  AppendBigEndian(b << 16 | a, 4, &zlib);
  return zlib;
}

// Adds the names of all extensions in `value` and below to `used`.
void FindExtensions(const nlohmann::json& value, std::set<std::string>* used) {
  if (value.is_object() && value.contains("extensions")) {
    for (const auto& [name, content] : value["extensions"].items()) used->insert(name);
  }
  if (!value.is_structured()) return;
  for (const nlohmann::json& part : value) FindExtensions(part, used);
}

}  // namespace

GltfDocument::GltfDocument() {
  json = {
      {"asset", {{"version", "2.0"}}},
      {"scene", 0},
      {"scenes", {{{"nodes", {0}}}}},
      {"nodes", {{{"mesh", 0}, {"name", "triangle"}}}},
      {"meshes",
       {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}}},
      {"materials",
       {{{"emissiveFactor", {1, 1, 1}},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.5, 0.5, 1}}, {"metallicFactor", 0}}}}}}};
  AddAccessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 5126, "VEC3", 3);
  AddAccessor<uint16_t>({0, 1, 2}, 5123, "SCALAR", 3);
}

int GltfDocument::AddViewBytes(const std::string& bytes) {
  binary_.resize((binary_.size() + 3) / 4 * 4);
  json["bufferViews"].push_back(
      {{"buffer", 0}, {"byteOffset", binary_.size()}, {"byteLength", bytes.size()}});
  binary_ += bytes;
  json["buffers"] = {{{"byteLength", binary_.size()}}};
  return static_cast<int>(json["bufferViews"].size()) - 1;
}

int GltfDocument::AddTexture(const std::string& image_bytes) {
  const int view = AddViewBytes(image_bytes);
  json["images"].push_back({{"bufferView", view}, {"mimeType", "image/png"}});
  json["textures"].push_back({{"source", json["images"].size() - 1}});
  if (!Primitive()["attributes"].contains("TEXCOORD_0")) {
    Primitive()["attributes"]["TEXCOORD_0"] =
        AddAccessor<float>({0, 0, 1, 0, 0, 1}, 5126, "VEC2", 3);
  }
  return static_cast<int>(json["textures"].size()) - 1;
}

std::string GltfDocument::Glb() const {
  nlohmann::json declared = json;
  std::set<std::string> used = json.value("extensionsUsed", std::set<std::string>());
  FindExtensions(json, &used);
  if (!used.empty()) declared["extensionsUsed"] = used;
  std::string body;
  AppendChunk("JSON", declared.dump(), ' ', &body);
  AppendChunk("BIN\0", binary_, '\0', &body);
  std::string glb = "glTF";
  AppendU32(2, &glb);
  AppendU32(static_cast<uint32_t>(body.size() + 12), &glb);
  return glb + body;
}

absl::StatusOr<Scene> GltfDocument::Load(const SceneLimits& limits) const {
  return LoadGltf({"test.glb", Glb(), {}}, limits);
}

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

std::string MakePng(uint32_t width, uint32_t height, const std::string& codes) {
  std::string header;
  AppendBigEndian(width, 4, &header);
  AppendBigEndian(height, 4, &header);
  header += std::string({8, 6, 0, 0, 0});  // 8 bits a channel, RGBA
  std::string rows;
  for (uint32_t y = 0; y < height && codes.size() >= 4 * width * (y + 1); ++y) {
    rows += '\0';  // no filter
    rows += codes.substr(4 * width * y, 4 * width);
  }
  std::string png = "\x89PNG\r\n\x1a\n";
  AppendPngChunk("IHDR", header, &png);
  AppendPngChunk("IDAT", Stored(rows), &png);
  AppendPngChunk("IEND", "", &png);
  return png;
}

}  // namespace lambert

#include "radiosity/scene/gltf_amend.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>

#include "absl/status/statusor.h"
#include "absl/strings/match.h"
#include "radiosity/scene/gltf_container.h"

namespace lambert {
namespace {

using nlohmann::json;
using nlohmann::json_literals::operator""_json_pointer;

constexpr char kMeshopt[] = "EXT_meshopt_compression";
constexpr char kDraco[] = "KHR_draco_mesh_compression";
// A file without any of these is right as it is.
constexpr const char* kAmended[] = {"\"skins\"", "\"animations\"", "\"sparse\"", kMeshopt, kDraco};

// The objects of list `name`.
std::vector<json*> ObjectsOf(json* gltf, const char* name) {
  std::vector<json*> objects;
  const auto list = gltf->find(name);
  if (list == gltf->end() || !list->is_array()) return objects;
  for (json& item : *list) {
    if (item.is_object()) objects.push_back(&item);
  }
  return objects;
}

// Sparse accessors without a buffer view of their own that primitives take their indices from.
std::vector<size_t> FindIndicesWithoutView(json* gltf) {
  std::vector<size_t> found;
  for (json* mesh : ObjectsOf(gltf, "meshes")) {
    for (json* primitive : ObjectsOf(mesh, "primitives")) {
      const auto index = primitive->find("indices");
      if (index == primitive->end() || !index->is_number_unsigned()) continue;
      const json::json_pointer pointer = "/accessors"_json_pointer / index->get<size_t>();
      if (!gltf->contains(pointer)) continue;
      const json& accessor = (*gltf)[pointer];
      if (!accessor.contains("sparse") || accessor.contains("bufferView")) continue;
      found.push_back(index->get<size_t>());
    }
  }
  return found;
}

bool Amend(json* gltf) {
  bool amended = false;
  for (json* skin : ObjectsOf(gltf, "skins")) {
    if (skin->contains("inverseBindMatrices")) continue;
    (*skin)["inverseBindMatrices"] = -1;
    amended = true;
  }
  for (json* mesh : ObjectsOf(gltf, "meshes")) {
    for (json* primitive : ObjectsOf(mesh, "primitives")) {
      if (!primitive->contains("/extensions"_json_pointer / kDraco)) continue;
      amended |= primitive->erase("indices") > 0;
    }
  }
  for (json* animation : ObjectsOf(gltf, "animations")) {
    for (json* channel : ObjectsOf(animation, "channels")) {
      const auto target = channel->find("target");
      if (target == channel->end() || !target->is_object() || target->contains("node")) continue;
      (*target)["node"] = -1;
      amended = true;
    }
  }
  for (json* buffer : ObjectsOf(gltf, "buffers")) {
    if (!IsFallbackBuffer(*buffer)) continue;
    (*buffer)["uri"] = "data:application/octet-stream;base64,AA==";
    (*buffer)["byteLength"] = 1;
    amended = true;
  }
  return amended;
}

void AppendUint32(size_t value, std::string* to) {
  for (int byte = 0; byte < 4; ++byte) to->push_back(static_cast<char>(value >> (8 * byte)));
}

// A GLB with another first chunk, which was `old_text`; the chunks that follow it stay.
std::string WithJson(const std::string& glb, absl::string_view old_text, std::string text) {
  constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;
  const size_t rest = old_text.data() - glb.data() + old_text.size();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string made = glb.substr(0, 8);
  AppendUint32(kHeaderBytes + kChunkHeaderBytes + text.size() + (glb.size() - rest), &made);
  AppendUint32(text.size(), &made);
  made += glb.substr(16, 4) + text;
  made.append(glb, rest, std::string::npos);
  return made;
}

}  // namespace

bool IsFallbackBuffer(const json& buffer) {
  const json::json_pointer pointer(std::string("/extensions/") + kMeshopt + "/fallback");
  return buffer.is_object() && buffer.contains(pointer) && buffer[pointer] == true;
}

std::optional<AmendedGltf> AmendGltf(const std::string& main_bytes) {
  const absl::StatusOr<absl::string_view> text = FindJsonText(main_bytes);
  if (!text.ok()) return std::nullopt;
  const auto holds = [&](const char* word) { return absl::StrContains(*text, word); };
  if (std::none_of(std::begin(kAmended), std::end(kAmended), holds)) return std::nullopt;
  json gltf = json::parse(text->begin(), text->end(), nullptr, false);
  if (!gltf.is_object()) return std::nullopt;
  const bool changed = Amend(&gltf);
  AmendedGltf amended{"", FindIndicesWithoutView(&gltf)};
  if (!changed && amended.without_view.empty()) return std::nullopt;
  for (size_t accessor : amended.without_view) gltf["accessors"][accessor]["bufferView"] = 0;
  amended.bytes = gltf.dump(-1, ' ', false, json::error_handler_t::replace);
  if (IsGlb(main_bytes)) amended.bytes = WithJson(main_bytes, *text, std::move(amended.bytes));
  return amended;
}

}  // namespace lambert

#include "radiosity/scene/gltf_appearance.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "absl/strings/match.h"
#include "radiosity/scene/gltf_accessor.h"

namespace lambert {
namespace {

using Json = nlohmann::json;

std::string BytesOf(const tinygltf::Model& model, const tinygltf::Image& image) {
  if (image.bufferView < 0) return {image.image.begin(), image.image.end()};
  const absl::StatusOr<ByteSpan> view = FindBufferView(model, image.bufferView);
  if (!view.ok()) return "";
  return {reinterpret_cast<const char*>(view->data), view->size};
}

// By the first bytes: a file may say another, or, of an image with a URI, none.
std::string MimeTypeOf(const std::string& bytes, const std::string& said) {
  if (absl::StartsWith(bytes, "\x89PNG")) return "image/png";
  if (absl::StartsWith(bytes, "\xff\xd8\xff")) return "image/jpeg";
  if (absl::StartsWith(bytes, "RIFF")) return "image/webp";
  if (absl::StartsWith(bytes, "\xabKTX 20")) return "image/ktx2";
  return said;
}

}  // namespace

Appearance ReadAppearance(absl::string_view text, const tinygltf::Model& model) {
  const Json gltf = Json::parse(text.begin(), text.end(), nullptr, false);
  Json kept;
  for (const char* list : {"materials", "textures", "samplers"}) {
    kept[list] = gltf.is_object() ? gltf.value(list, Json::array()) : Json::array();
  }
  Appearance appearance;
  kept["images"] = Json::array();
  for (const tinygltf::Image& image : model.images) {
    appearance.images.push_back(BytesOf(model, image));
    Json entry = {{"mimeType", MimeTypeOf(appearance.images.back(), image.mimeType)}};
    if (!image.name.empty()) entry["name"] = image.name;
    kept["images"].push_back(std::move(entry));
  }
  appearance.json = kept.dump(-1, ' ', false, Json::error_handler_t::replace);
  return appearance;
}

}  // namespace lambert

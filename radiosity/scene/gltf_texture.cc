#include "radiosity/scene/gltf_texture.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_extensions.h"

namespace lambert {
namespace {

constexpr char kTransform[] = "KHR_texture_transform";

int IntegerOf(const nlohmann::json& object, const char* field, int absent) {
  const auto found = object.find(field);
  return found != object.end() && found->is_number_integer() ? found->get<int>() : absent;
}

// Translation * rotation * scale. The rotation is counter-clockwise in the picture, whose v runs
// downwards.
absl::Status ReadTransform(const nlohmann::json& transform, const std::string& where,
                           TextureUse* use) {
  const absl::StatusOr<std::vector<double>> offset = NumbersOf(transform, "offset", {0, 0}, where);
  if (!offset.ok()) return offset.status();
  const absl::StatusOr<std::vector<double>> rotation = NumbersOf(transform, "rotation", {0}, where);
  if (!rotation.ok()) return rotation.status();
  const absl::StatusOr<std::vector<double>> scale = NumbersOf(transform, "scale", {1, 1}, where);
  if (!scale.ok()) return scale.status();
  const double c = std::cos(rotation->front()), s = std::sin(rotation->front());
  use->row_u = {(*scale)[0] * c, (*scale)[1] * s, (*offset)[0]};
  use->row_v = {(*scale)[0] * -s, (*scale)[1] * c, (*offset)[1]};
  for (const auto& row : {use->row_u, use->row_v}) {
    for (double x : row) {
      if (!std::isfinite(x)) {
        return SceneError(where, absl::StrCat(kTransform, " is not finite"),
                          "export the file again");
      }
    }
  }
  return absl::OkStatus();
}

}  // namespace

TextureInfo TextureInfoOf(const nlohmann::json& extension, const char* field) {
  const auto found = extension.find(field);
  if (found == extension.end() || !found->is_object()) return {};
  TextureInfo info{IntegerOf(*found, "index", -1), IntegerOf(*found, "texCoord", 0), ""};
  if (found->contains("extensions")) info.extensions_json = (*found)["extensions"].dump();
  return info;
}

absl::StatusOr<TextureUse> ReadTexture(const TextureInfo& info, const std::string& where,
                                       TextureLoader* textures, UnreadFeatures* unread) {
  if (info.index < 0) return TextureUse{};
  TextureUse use{.texture = -1, .uv_set = info.uv_set};
  const nlohmann::json transform = FindExtension(info.extensions_json, kTransform);
  if (transform.is_object()) {
    absl::Status status = ReadTransform(transform, where, &use);
    if (!status.ok()) return status;
    use.uv_set = IntegerOf(transform, "texCoord", use.uv_set);
  }
  absl::StatusOr<int> texture = textures->Load(info.index);
  if (!texture.ok()) return texture.status();
  if (*texture < 0) unread->Add("images that are no PNG or JPEG", "texture", "left out");
  use.texture = *texture;
  return use;
}

}  // namespace lambert

// Where a material's textures are and how their coordinates are made.
#pragma once

#include <tiny_gltf.h>

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/scene/gltf_image.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/unread_features.h"

namespace lambert {

// A textureInfo of a glTF file, wherever it stands.
struct TextureInfo {
  int index = -1;  // of the texture; -1: none
  int uv_set = 0;
  std::string extensions_json;
};

// The texture info `field` of an extension's object; none where it has none or it is malformed.
TextureInfo TextureInfoOf(const nlohmann::json& extension, const char* field);

// The texture that `info` names, decoded, with its KHR_texture_transform; none where it has no
// image that is read, which is counted. SceneError naming `where` for a transform that is not made
// of finite numbers, and the errors of TextureLoader::Load.
absl::StatusOr<TextureUse> ReadTexture(const TextureInfo& info, const std::string& where,
                                       TextureLoader* textures, UnreadFeatures* unread);

}  // namespace lambert

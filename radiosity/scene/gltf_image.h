// Textures that materials use, decoded.
#pragma once

#include <tiny_gltf.h>

#include <map>
#include <utility>

#include "absl/status/statusor.h"
#include "radiosity/scene/load_gltf.h"

namespace lambert {

// Turns glTF texture indices into indices of `textures`; an image is decoded when it is asked for
// the first time, and only then.
class TextureLoader {
 public:
  // The model, the limits and the vector must outlive the loader.
  TextureLoader(const tinygltf::Model& model, const SceneLimits& limits,
                std::vector<Texture>* textures)
      : model_(model), limits_(limits), textures_(textures) {}

  // Index into `textures` of glTF texture `texture`, or -1 where its image is of a kind that an
  // unread extension brings. SceneError for what does not exist or cannot be decoded,
  // SCENE_TOO_LARGE over the limits.
  absl::StatusOr<int> Load(int texture);

 private:
  absl::StatusOr<Texture> Decode(int image);

  const tinygltf::Model& model_;
  const SceneLimits& limits_;
  std::vector<Texture>* textures_;
  std::map<std::pair<int, int>, int> loaded_;  // glTF image and sampler -> index into textures
  int64_t pixels_ = 0;                         // decoded so far
};

}  // namespace lambert

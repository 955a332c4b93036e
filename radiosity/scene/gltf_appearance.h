// Materials of a file with their textures, as they stand.
#pragma once

#include <tiny_gltf.h>

#include "absl/strings/string_view.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// `text`: the file's JSON; `model`: what was parsed of it. An image that lies outside its buffer,
// or did not come with the scene, is empty.
Appearance ReadAppearance(absl::string_view text, const tinygltf::Model& model);

}  // namespace lambert

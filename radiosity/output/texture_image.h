// Textures as image files.
#pragma once

#include <string>

#include "radiosity/scene/scene.h"

namespace lambert {

struct ImageBytes {
  std::string bytes;
  std::string mime_type;  // "image/jpeg" where all is opaque, else "image/png"
};

// The texture, its linear values times `gain`, rolled off towards white over .8 as in Develop; as
// it is with a gain of 1. Requires: pixels; gain >= 1.
ImageBytes EncodeTexture(const Texture& texture, double gain);

}  // namespace lambert

// PNG and JPEG bytes -> pixels, within limits that are checked before anything is decoded.
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/scene/scene.h"

namespace lambert {

struct ImageSize {
  int width = 0, height = 0;  // pixels
};

// The size that the header of a PNG or JPEG states. SceneError naming `where` for other bytes.
absl::StatusOr<ImageSize> ReadImageSize(const unsigned char* bytes, uint64_t size,
                                        const std::string& where);

// Decodes to 8-bit RGBA. Memory stays within a small multiple of the size that the header states,
// whatever the compressed data would grow to. SceneError naming `where` for broken data.
absl::StatusOr<Texture> DecodeImage(const unsigned char* bytes, uint64_t size,
                                    const std::string& where);

}  // namespace lambert

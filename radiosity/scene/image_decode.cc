#include "radiosity/scene/image_decode.h"

#include <cstdlib>
#include <limits>
#include <memory>

#include "radiosity/core/error.h"

namespace lambert {
namespace {

// Bytes that the decoder in this thread may still ask for. A compressed file of a kilobyte can ask
// for gigabytes that its header does not mention.
thread_local int64_t allowance = 0;

void* AllocateWithin(size_t size) {
  if (static_cast<int64_t>(size) > allowance) return nullptr;
  allowance -= static_cast<int64_t>(size);
  return std::malloc(size);
}

void* ReallocateWithin(void* old, size_t old_size, size_t size) {
  allowance += static_cast<int64_t>(old_size);
  if (static_cast<int64_t>(size) > allowance) return nullptr;
  allowance -= static_cast<int64_t>(size);
  return std::realloc(old, size);
}

}  // namespace
}  // namespace lambert

// The two formats of glTF, and memory that is counted.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MALLOC(size) lambert::AllocateWithin(size)
#define STBI_REALLOC_SIZED(old, old_size, size) lambert::ReallocateWithin(old, old_size, size)
#define STBI_FREE(memory) std::free(memory)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace lambert {
namespace {

// The decoders hold at most the filtered 16-bit samples, the unfiltered ones and the result, with a
// buffer that doubles: 48 bytes a pixel covers PNG and progressive JPEG.
constexpr int64_t kBytesPerPixel = 48, kBytesFixed = 4 << 20;

absl::Status Undecodable(const std::string& where) {
  return SceneError(where,
                    "it is not a PNG or JPEG image that can be decoded, or it is far too large",
                    "save the image again as PNG or JPEG");
}

}  // namespace

absl::StatusOr<ImageSize> ReadImageSize(const unsigned char* bytes, uint64_t size,
                                        const std::string& where) {
  allowance = kBytesFixed;
  ImageSize image;
  int channels = 0;
  if (size == 0 || size > static_cast<uint64_t>(std::numeric_limits<int>::max()) ||
      !stbi_info_from_memory(bytes, static_cast<int>(size), &image.width, &image.height,
                             &channels) ||
      image.width < 1 || image.height < 1) {
    return Undecodable(where);
  }
  return image;
}

absl::StatusOr<Texture> DecodeImage(const unsigned char* bytes, uint64_t size,
                                    const std::string& where) {
  absl::StatusOr<ImageSize> header = ReadImageSize(bytes, size, where);
  if (!header.ok()) return header.status();
  const int64_t pixels = int64_t{1} * header->width * header->height;
  allowance = kBytesFixed + 2 * static_cast<int64_t>(size) + kBytesPerPixel * pixels;
  Texture texture;
  int channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&std::free)> data(
      stbi_load_from_memory(bytes, static_cast<int>(size), &texture.width, &texture.height,
                            &channels, 4),
      &std::free);
  if (data == nullptr) return Undecodable(where);
  const int64_t decoded = int64_t{4} * texture.width * texture.height;
  texture.rgba.assign(data.get(), data.get() + decoded);
  return texture;
}

}  // namespace lambert

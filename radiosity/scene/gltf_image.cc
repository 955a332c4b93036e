#include "radiosity/scene/gltf_image.h"

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_container.h"
#include "radiosity/scene/image_decode.h"

namespace lambert {
namespace {

absl::Status Missing(const std::string& where, const std::string& what, int index) {
  return SceneError(where, absl::StrCat(what, " ", index, " does not exist"),
                    "export the file again");
}

absl::Status TooLarge(const std::string& where, const std::string& message) {
  return MakeError(absl::StatusCode::kInvalidArgument,
                   {"SCENE_TOO_LARGE", where, message, "scale the images down"});
}

Texture::Wrap WrapOf(int gltf_wrap) {
  if (gltf_wrap == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Wrap::kClampToEdge;
  if (gltf_wrap == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) return Texture::Wrap::kMirroredRepeat;
  return Texture::Wrap::kRepeat;
}

}  // namespace

absl::StatusOr<Texture> TextureLoader::Decode(int index) {
  const std::string where = absl::StrCat("image ", index);
  const tinygltf::Image& image = model_.images[index];
  ByteSpan bytes{image.image.data(), image.image.size()};
  if (image.bufferView >= 0) {
    absl::StatusOr<ByteSpan> view = FindBufferView(model_, image.bufferView);
    if (!view.ok()) return view.status();
    bytes = *view;
  } else if (bytes.size == 0) {
    return SceneError(
        where, absl::StrCat("file \"", Printable(image.uri), "\" did not come with the scene"),
        "put it beside the scene, or export a GLB with everything inside");
  }
  absl::StatusOr<ImageSize> size = ReadImageSize(bytes.data, bytes.size, where);
  if (!size.ok()) return size.status();
  const int64_t pixels = int64_t{1} * size->width * size->height;
  if (pixels > limits_.image_pixels) {
    return TooLarge(where, absl::StrCat(size->width, " x ", size->height, " pixels, more than ",
                                        limits_.image_pixels));
  }
  pixels_ += pixels;
  if (pixels_ > limits_.total_pixels) {
    return TooLarge(where, absl::StrCat("all images together have more than ", limits_.total_pixels,
                                        " pixels"));
  }
  return DecodeImage(bytes.data, bytes.size, where);
}

absl::StatusOr<int> TextureLoader::Load(int index) {
  const std::string where = absl::StrCat("texture ", index);
  if (index < 0 || index >= static_cast<int>(model_.textures.size())) {
    return SceneError(where, "it does not exist", "export the file again");
  }
  const tinygltf::Texture& gltf = model_.textures[index];
  if (gltf.source < 0) return -1;
  if (gltf.source >= static_cast<int>(model_.images.size())) {
    return Missing(where, "image", gltf.source);
  }
  if (gltf.sampler >= static_cast<int>(model_.samplers.size())) {
    return Missing(where, "sampler", gltf.sampler);
  }
  const auto [it, is_new] = loaded_.try_emplace({gltf.source, std::max(gltf.sampler, -1)}, -1);
  if (!is_new) return it->second;
  // An image with two samplers is decoded twice: rare, and it keeps textures plain values.
  absl::StatusOr<Texture> texture = Decode(gltf.source);
  if (!texture.ok()) return texture.status();
  if (gltf.sampler >= 0) {
    texture->wrap_u = WrapOf(model_.samplers[gltf.sampler].wrapS);
    texture->wrap_v = WrapOf(model_.samplers[gltf.sampler].wrapT);
  }
  it->second = static_cast<int>(textures_->size());
  textures_->push_back(*std::move(texture));
  return it->second;
}

}  // namespace lambert

// tinygltf is compiled here and nowhere else: the library of Draco brings another version of it
// under the same names.
#define TINYGLTF_IMPLEMENTATION
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#include "radiosity/scene/gltf_parse.h"

#include <exception>
#include <optional>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/strip.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_amend.h"
#include "radiosity/scene/gltf_container.h"

namespace lambert {
namespace {

// What tinygltf's file callbacks see: the files of the bundle, and nothing else.
struct BundleFiles {
  const SceneBundle* bundle;
  std::string missing;  // the file asked for last that is not there
};

// tinygltf asks for "name" and "./name", and decodes '+' in a URI to a space.
const std::string* FindFile(const std::string& path, const BundleFiles& files) {
  std::string name = path;
  while (absl::StartsWith(name, "./")) name.erase(0, 2);
  for (const auto& [uri, bytes] : files.bundle->files) {
    if (uri == name || absl::StrReplaceAll(uri, {{"+", " "}}) == name) return &bytes;
  }
  return nullptr;
}

bool FileExists(const std::string& path, void* user_data) {
  BundleFiles* files = static_cast<BundleFiles*>(user_data);
  if (FindFile(path, *files) != nullptr) return true;
  files->missing = std::string(absl::StripPrefix(path, "./"));
  return false;
}

std::string KeepPath(const std::string& path, void*) { return path; }

bool ReadFile(std::vector<unsigned char>* out, std::string*, const std::string& path,
              void* user_data) {
  const std::string* bytes = FindFile(path, *static_cast<BundleFiles*>(user_data));
  if (bytes == nullptr) return false;
  out->assign(bytes->begin(), bytes->end());
  return true;
}

bool RefuseToWrite(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

// Keeps an image as it is encoded. Bytes in a buffer view are left where they are: tinygltf has not
// checked that the view lies inside its buffer.
bool KeepEncoded(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                 const unsigned char* bytes, int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

absl::Status ParseFailure(std::string message, const BundleFiles& files) {
  if (!files.missing.empty() && message.find(files.missing) != std::string::npos) {
    return SceneError("file \"" + Printable(files.missing) + "\"", "it did not come with the scene",
                      "put it beside the scene, or export a GLB with everything inside");
  }
  message = Printable(std::string(absl::StripAsciiWhitespace(message)));
  return SceneError("glTF", message.empty() ? "it cannot be parsed" : message,
                    "check it with a glTF validator, or export it again");
}

}  // namespace

absl::StatusOr<tinygltf::Model> ParseModel(const SceneBundle& bundle) {
  BundleFiles files{&bundle, ""};
  tinygltf::Model model;
  std::string error, warning;
  const std::optional<AmendedGltf> amended = AmendGltf(bundle.main_bytes);
  const std::string& bytes = amended ? amended->bytes : bundle.main_bytes;
  bool ok = false;
  try {
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({FileExists, KeepPath, ReadFile, RefuseToWrite, &files});
    parser.SetImageLoader(KeepEncoded, nullptr);
    // Its own values hold integers as int and drop the rest; extensions are read from their text.
    parser.SetStoreOriginalJSONForExtrasAndExtensions(true);
    ok = IsGlb(bytes)
             ? parser.LoadBinaryFromMemory(&model, &error, &warning,
                                           reinterpret_cast<const unsigned char*>(bytes.data()),
                                           static_cast<unsigned int>(bytes.size()))
             : parser.LoadASCIIFromString(&model, &error, &warning, bytes.data(),
                                          static_cast<unsigned int>(bytes.size()), "");
  } catch (const std::exception& exception) {
    ok = false;
    error = exception.what();
  }
  // An error beside success is a part that tinygltf left out; a scene with parts missing is not the
  // scene that was meant.
  if (!ok || !error.empty()) return ParseFailure(error, files);
  if (amended) {
    for (size_t accessor : amended->without_view) model.accessors[accessor].bufferView = -1;
  }
  return model;
}

}  // namespace lambert

#include "radiosity/scene/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"
#include "radiosity/scene/gltf_accessor.h"
#include "radiosity/scene/gltf_extensions.h"

namespace lambert {
namespace {

constexpr char kExtension[] = "EXT_meshopt_compression";

// The codec spends at least a bit pair on 16 bytes of a column, so a byte of it is at most 64.
constexpr uint64_t kMostDecodedPerByte = 64;

absl::Status Malformed(const std::string& where, const std::string& what) {
  return SceneError(where, absl::StrCat(what, " (", kExtension, ")"),
                    "compress the file again, or export it without compression");
}

struct Compressed {
  ByteSpan bytes;
  uint64_t count = 0, stride = 0;
  std::string mode, filter;
};

absl::StatusOr<uint64_t> SizeOf(const nlohmann::json& extension, const char* field,
                                const std::string& where) {
  const auto found = extension.find(field);
  if (found == extension.end()) return 0;
  if (!found->is_number_unsigned()) return Malformed(where, absl::StrCat(field, " is no size"));
  return found->get<uint64_t>();
}

absl::StatusOr<ByteSpan> FindBytes(const tinygltf::Model& model, const nlohmann::json& extension,
                                   const std::string& where) {
  const absl::StatusOr<uint64_t> buffer = SizeOf(extension, "buffer", where);
  if (!buffer.ok()) return buffer.status();
  const absl::StatusOr<uint64_t> offset = SizeOf(extension, "byteOffset", where);
  if (!offset.ok()) return offset.status();
  const absl::StatusOr<uint64_t> length = SizeOf(extension, "byteLength", where);
  if (!length.ok()) return length.status();
  if (*buffer >= model.buffers.size()) {
    return Malformed(where, absl::StrCat("its buffer ", *buffer, " does not exist"));
  }
  const std::vector<unsigned char>& data = model.buffers[*buffer].data;
  if (*length > data.size() || *offset > data.size() - *length) {
    return Malformed(where, "it runs past its buffer");
  }
  return ByteSpan{data.data() + *offset, *length};
}

absl::StatusOr<Compressed> ReadCompressed(const tinygltf::Model& model,
                                          const nlohmann::json& extension,
                                          const std::string& where) {
  Compressed compressed;
  const absl::StatusOr<ByteSpan> bytes = FindBytes(model, extension, where);
  if (!bytes.ok()) return bytes.status();
  compressed.bytes = *bytes;
  const absl::StatusOr<uint64_t> count = SizeOf(extension, "count", where);
  if (!count.ok()) return count.status();
  const absl::StatusOr<uint64_t> stride = SizeOf(extension, "byteStride", where);
  if (!stride.ok()) return stride.status();
  compressed.count = *count;
  compressed.stride = *stride;
  const nlohmann::json mode = extension.value("mode", nlohmann::json());
  const nlohmann::json filter = extension.value("filter", nlohmann::json("NONE"));
  if (!mode.is_string() || !filter.is_string()) return Malformed(where, "its mode is no name");
  compressed.mode = mode;
  compressed.filter = filter;
  return compressed;
}

// What the decoders require of their arguments.
bool IsValid(const Compressed& c) {
  if (c.mode == "ATTRIBUTES") {
    if (c.stride == 0 || c.stride > 256 || c.stride % 4 != 0) return false;
    return c.filter == "NONE" || c.filter == "EXPONENTIAL" ||
           (c.filter == "OCTAHEDRAL" && (c.stride == 4 || c.stride == 8)) ||
           (c.filter == "QUATERNION" && c.stride == 8);
  }
  return c.filter == "NONE" && (c.stride == 2 || c.stride == 4) &&
         (c.mode == "INDICES" || (c.mode == "TRIANGLES" && c.count % 3 == 0));
}

bool Decode(const Compressed& c, unsigned char* to) {
  if (c.mode == "TRIANGLES") {
    return meshopt_decodeIndexBuffer(to, c.count, c.stride, c.bytes.data, c.bytes.size) == 0;
  }
  if (c.mode == "INDICES") {
    return meshopt_decodeIndexSequence(to, c.count, c.stride, c.bytes.data, c.bytes.size) == 0;
  }
  if (meshopt_decodeVertexBuffer(to, c.count, c.stride, c.bytes.data, c.bytes.size) != 0) {
    return false;
  }
  if (c.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(to, c.count, c.stride);
  if (c.filter == "QUATERNION") meshopt_decodeFilterQuat(to, c.count, c.stride);
  if (c.filter == "EXPONENTIAL") meshopt_decodeFilterExp(to, c.count, c.stride);
  return true;
}

}  // namespace

absl::Status DecodeMeshopt(int64_t most_bytes, tinygltf::Model* model) {
  uint64_t left = static_cast<uint64_t>(most_bytes);
  for (size_t i = 0; i < model->bufferViews.size(); ++i) {
    const nlohmann::json extension =
        FindExtension(model->bufferViews[i].extensions_json_string, kExtension);
    if (!extension.is_object()) continue;
    const std::string where = absl::StrCat("buffer view ", i);
    const absl::StatusOr<Compressed> compressed = ReadCompressed(*model, extension, where);
    if (!compressed.ok()) return compressed.status();
    if (!IsValid(*compressed)) return Malformed(where, "mode, filter and stride do not suit");
    const uint64_t most = compressed->bytes.size * kMostDecodedPerByte;
    if (compressed->count > most / compressed->stride) {
      return Malformed(where, absl::StrCat("its ", compressed->bytes.size, " bytes cannot hold ",
                                           compressed->count, " elements"));
    }
    const uint64_t bytes = compressed->count * compressed->stride;
    if (bytes > left) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"SCENE_TOO_LARGE", where, "the scene's buffers are too large decompressed",
                        "simplify its meshes"});
    }
    left -= bytes;
    tinygltf::Buffer decoded;
    decoded.data.resize(bytes);
    if (!Decode(*compressed, decoded.data.data())) {
      return Malformed(where, "its compressed data is damaged");
    }
    model->buffers.push_back(std::move(decoded));
    tinygltf::BufferView& view = model->bufferViews[i];
    view.buffer = static_cast<int>(model->buffers.size()) - 1;
    view.byteOffset = 0;
    view.byteLength = bytes;
  }
  return absl::OkStatus();
}

}  // namespace lambert

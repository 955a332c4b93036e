#include "radiosity/scene/gltf_accessor.h"

#include <algorithm>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr char kExportAgain[] = "export the file again";

// An accessor may have no data at all and be zeros: a line of JSON must not become gigabytes.
constexpr uint64_t kMostZeros = 1 << 20;

template <typename T>
T Load(const unsigned char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

template <typename T>
float ToFloat(const unsigned char* from, bool normalized) {
  const T value = Load<T>(from);
  if (!normalized) return static_cast<float>(value);
  // glTF 2.0, 3.6.2.2: c / max, and for signed types not below -1.
  return std::max(static_cast<float>(value) / std::numeric_limits<T>::max(), -1.0f);
}

float ComponentToFloat(int type, const unsigned char* from, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return ToFloat<int8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return ToFloat<uint8_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return ToFloat<int16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return ToFloat<uint16_t>(from, normalized);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return ToFloat<uint32_t>(from, normalized);
    default:
      return Load<float>(from);
  }
}

// 0 for types that glTF does not know.
int ComponentBytes(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

uint32_t LoadIndex(int type, const unsigned char* from) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *from;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return Load<uint16_t>(from);
    default:
      return Load<uint32_t>(from);
  }
}

// True where `count` elements of `element` bytes, `stride` apart, fit into `size` bytes from
// `offset` on. Written so that no product or sum overflows.
bool Fits(uint64_t offset, uint64_t count, uint64_t stride, uint64_t element, uint64_t size) {
  if (count == 0) return offset <= size;
  if (offset > size || element > size - offset) return false;
  return count - 1 <= (size - offset - element) / stride;
}

}  // namespace

absl::StatusOr<ByteSpan> FindBufferView(const tinygltf::Model& model, int view) {
  const std::string where = absl::StrCat("buffer view ", view);
  if (view < 0 || view >= static_cast<int>(model.bufferViews.size())) {
    return SceneError(where, "it does not exist", kExportAgain);
  }
  const tinygltf::BufferView& range = model.bufferViews[view];
  if (range.buffer < 0 || range.buffer >= static_cast<int>(model.buffers.size())) {
    return SceneError(where, absl::StrCat("its buffer ", range.buffer, " does not exist"),
                      kExportAgain);
  }
  const std::vector<unsigned char>& data = model.buffers[range.buffer].data;
  if (!Fits(range.byteOffset, range.byteLength, 1, 1, data.size())) {
    return SceneError(where, absl::StrCat("it runs past the ", data.size(), " bytes of its buffer"),
                      kExportAgain);
  }
  return ByteSpan{data.data() + range.byteOffset, range.byteLength};
}

absl::StatusOr<AccessorReader> AccessorReader::Make(const tinygltf::Model& model, int index,
                                                    int type) {
  const std::string where = absl::StrCat("accessor ", index);
  if (index < 0 || index >= static_cast<int>(model.accessors.size())) {
    return SceneError(where, "it does not exist", kExportAgain);
  }
  const tinygltf::Accessor& accessor = model.accessors[index];
  AccessorReader reader;
  reader.component_type_ = accessor.componentType;
  reader.component_bytes_ = ComponentBytes(accessor.componentType);
  if (accessor.type != type || reader.component_bytes_ == 0) {
    return SceneError(where, "its type does not suit its use", kExportAgain);
  }
  reader.components_ = tinygltf::GetNumComponentsInType(type);
  reader.count_ = accessor.count;
  reader.normalized_ = accessor.normalized;
  const uint64_t element = reader.component_bytes_ * reader.components_;
  reader.stride_ = element;
  if (accessor.bufferView >= 0) {
    absl::StatusOr<ByteSpan> view = FindBufferView(model, accessor.bufferView);
    if (!view.ok()) return view.status();
    const uint64_t stride = model.bufferViews[accessor.bufferView].byteStride;
    if (stride > 0) reader.stride_ = stride;
    if (reader.stride_ < element) {
      return SceneError(where, "its stride is smaller than its elements", kExportAgain);
    }
    if (!Fits(accessor.byteOffset, reader.count_, reader.stride_, element, view->size)) {
      return SceneError(where, absl::StrCat("count ", reader.count_, " runs past its buffer view"),
                        kExportAgain);
    }
    reader.data_ = view->data + accessor.byteOffset;
  } else if (reader.count_ > kMostZeros) {
    return MakeError(
        absl::StatusCode::kInvalidArgument,
        {"SCENE_TOO_LARGE", where,
         absl::StrCat("it stands for ", reader.count_, " zeros without data"), kExportAgain});
  }
  if (accessor.sparse.isSparse) {
    absl::Status status = reader.ReadSparse(model, accessor, where);
    if (!status.ok()) return status;
  }
  return reader;
}

absl::Status AccessorReader::ReadSparse(const tinygltf::Model& model,
                                        const tinygltf::Accessor& accessor,
                                        const std::string& where) {
  const auto& sparse = accessor.sparse;
  const int index_bytes = ComponentBytes(sparse.indices.componentType);
  const uint64_t element = component_bytes_ * components_;
  absl::StatusOr<ByteSpan> indices = FindBufferView(model, sparse.indices.bufferView);
  if (!indices.ok()) return indices.status();
  absl::StatusOr<ByteSpan> values = FindBufferView(model, sparse.values.bufferView);
  if (!values.ok()) return values.status();
  if (sparse.count < 0 || index_bytes == 0 || sparse.indices.byteOffset < 0 ||
      sparse.values.byteOffset < 0 ||
      !Fits(sparse.indices.byteOffset, sparse.count, index_bytes, index_bytes, indices->size) ||
      !Fits(sparse.values.byteOffset, sparse.count, element, element, values->size)) {
    return SceneError(where, "its sparse part runs past its buffer view", kExportAgain);
  }
  for (int k = 0; k < sparse.count; ++k) {
    const uint32_t i =
        LoadIndex(sparse.indices.componentType,
                  indices->data + sparse.indices.byteOffset + uint64_t{1} * k * index_bytes);
    if (i >= count_) {
      return SceneError(where, absl::StrCat("sparse index ", i, " is not under its count"),
                        kExportAgain);
    }
    sparse_[i] = values->data + sparse.values.byteOffset + k * element;
  }
  return absl::OkStatus();
}

const unsigned char* AccessorReader::Find(uint64_t i) const {
  if (!sparse_.empty()) {
    if (const auto it = sparse_.find(i); it != sparse_.end()) return it->second;
  }
  return data_ == nullptr ? nullptr : data_ + i * stride_;
}

void AccessorReader::Floats(uint64_t i, float* out) const {
  const unsigned char* from = Find(i);
  for (int k = 0; k < components_; ++k) {
    out[k] = from == nullptr
                 ? 0
                 : ComponentToFloat(component_type_, from + k * component_bytes_, normalized_);
  }
}

uint32_t AccessorReader::Index(uint64_t i) const {
  const unsigned char* from = Find(i);
  return from == nullptr ? 0 : LoadIndex(component_type_, from);
}

}  // namespace lambert

// Reads elements of accessors where they lie: strides, types, normalisation and sparse values.
#pragma once

#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <string>

#include "absl/container/flat_hash_map.h"
#include "absl/status/statusor.h"

namespace lambert {

// Bytes of a buffer view; the model must outlive them.
struct ByteSpan {
  const unsigned char* data = nullptr;
  uint64_t size = 0;
};
// SceneError naming the view where it, or its buffer, does not exist or is too short.
absl::StatusOr<ByteSpan> FindBufferView(const tinygltf::Model& model, int view);

// An accessor whose every element is known to lie inside its buffer. Immutable once made; the model
// must outlive it.
class AccessorReader {
 public:
  // `type` is TINYGLTF_TYPE_SCALAR, _VEC2 or _VEC3. SceneError naming the accessor where it does
  // not exist, has another type, or runs past its data.
  static absl::StatusOr<AccessorReader> Make(const tinygltf::Model& model, int accessor, int type);

  uint64_t count() const { return count_; }
  int component_type() const { return component_type_; }

  // Element `i` as floats (`out`: as many as the type has components), normalised integers mapped
  // to -1..1 or 0..1. Requires: i < count().
  void Floats(uint64_t i, float* out) const;
  // Element `i` of an unsigned integer SCALAR. Requires: i < count().
  uint32_t Index(uint64_t i) const;

 private:
  // Where element i lies; nullptr for the zeros of an accessor without a buffer view.
  const unsigned char* Find(uint64_t i) const;
  absl::Status ReadSparse(const tinygltf::Model& model, const tinygltf::Accessor& accessor,
                          const std::string& where);

  const unsigned char* data_ = nullptr;
  uint64_t count_ = 0, stride_ = 0;
  int component_type_ = 0, component_bytes_ = 0, components_ = 0;
  bool normalized_ = false;
  absl::flat_hash_map<uint64_t, const unsigned char*> sparse_;  // element -> its own value
};

}  // namespace lambert

// Little-endian encoding of plain values, for the canonical formats of docs/formats.md.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

namespace lambert {

static_assert(std::endian::native == std::endian::little,
              "values are copied as they lie in memory");

// Appends values to a string.
class ByteWriter {
 public:
  template <typename T>
  void Put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  // `count` values without a length before them.
  template <typename T>
  void PutArray(const T* values, size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (count > 0) bytes_.append(reinterpret_cast<const char*>(values), count * sizeof(T));
  }
  std::string Take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Reads them back. A read past the end fails, and so does every read after it.
class ByteReader {
 public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

  template <typename T>
  bool Get(T* value) {
    return GetArray(value, 1);
  }
  template <typename T>
  bool GetArray(T* values, size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (failed_ || count > remaining() / sizeof(T)) {
      failed_ = true;
      return false;
    }
    if (count > 0) std::memcpy(values, bytes_.data() + position_, count * sizeof(T));
    position_ += count * sizeof(T);
    return true;
  }
  size_t remaining() const { return bytes_.size() - position_; }
  // Nothing failed and nothing is left over.
  bool Complete() const { return !failed_ && remaining() == 0; }

 private:
  const std::string& bytes_;
  size_t position_ = 0;
  bool failed_ = false;
};

}  // namespace lambert

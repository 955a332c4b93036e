// SHA-256, by which blobs, scenes and patch sets are named.
#pragma once

#include <cstddef>
#include <string>

namespace lambert {

// Lower-case hexadecimal SHA-256 (64 characters) of `size` bytes at `data`.
std::string Sha256Hex(const void* data, size_t size);
inline std::string Sha256Hex(const std::string& bytes) {
  return Sha256Hex(bytes.data(), bytes.size());
}

// True for 64 characters of 0-9a-f: the only names under which blobs are kept.
bool IsSha256Hex(const std::string& text);

}  // namespace lambert

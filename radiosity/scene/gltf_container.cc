#include "radiosity/scene/gltf_container.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "radiosity/core/error.h"

namespace lambert {
namespace {

constexpr uint32_t kJsonChunk = 0x4e4f534a;    // "JSON"
constexpr uint32_t kBinaryChunk = 0x004e4942;  // "BIN"
constexpr size_t kGlbHeaderBytes = 12, kChunkHeaderBytes = 8;

// glTF itself nests 8 deep; extensions and extras add a few.
constexpr int kMaxJsonDepth = 100;

constexpr size_t kMaxQuotedBytes = 200;

uint32_t ReadU32(const std::string& bytes, size_t offset) {
  uint32_t value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

absl::Status GlbError(const std::string& message) {
  return SceneError("GLB container", message, "export the file again");
}

absl::StatusOr<absl::string_view> FindGlbJson(const std::string& bytes) {
  if (bytes.size() < kGlbHeaderBytes + kChunkHeaderBytes) {
    return GlbError("it ends before its first chunk");
  }
  if (const uint32_t version = ReadU32(bytes, 4); version != 2) {
    return SceneError("GLB container", absl::StrCat("its version is ", version),
                      "convert the file to glTF 2.0");
  }
  const uint64_t length = ReadU32(bytes, 8), json = ReadU32(bytes, 12);
  if (length > bytes.size()) {
    return GlbError(absl::StrCat("it says ", length, " bytes, but holds ", bytes.size()));
  }
  if (ReadU32(bytes, 16) != kJsonChunk) return GlbError("its first chunk is not JSON");
  if (kGlbHeaderBytes + kChunkHeaderBytes + json > length) {
    return GlbError("its JSON chunk runs past its end");
  }
  return absl::string_view(bytes).substr(kGlbHeaderBytes + kChunkHeaderBytes, json);
}

// The chunks after the first, which FindGlbJson has checked.
absl::Status CheckChunks(const std::string& bytes, bool* is_aligned) {
  const uint64_t length = ReadU32(bytes, 8);
  bool has_binary = false;
  uint64_t at = kGlbHeaderBytes;
  while (at + kChunkHeaderBytes <= length) {
    const uint64_t size = ReadU32(bytes, at);
    const uint32_t type = ReadU32(bytes, at + 4);
    if (size > length - at - kChunkHeaderBytes) return GlbError("a chunk runs past its end");
    if ((type == kJsonChunk && at > kGlbHeaderBytes) || (type == kBinaryChunk && has_binary)) {
      return GlbError("it has two chunks of one type");
    }
    has_binary |= type == kBinaryChunk;
    if (size % 4 != 0) *is_aligned = false;
    at += kChunkHeaderBytes + size;
  }
  return at == length ? absl::OkStatus() : GlbError("its last chunk has no whole header");
}

// Depth of nesting in JSON text, valid or not; counting ends above the limit.
int NestingDepth(absl::string_view text) {
  int depth = 0, deepest = 0;
  bool in_string = false;
  for (size_t i = 0; i < text.size() && deepest <= kMaxJsonDepth; ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

int HexValue(char c) {
  if (!absl::ascii_isxdigit(static_cast<unsigned char>(c))) return -1;
  return absl::ascii_isdigit(static_cast<unsigned char>(c))
             ? c - '0'
             : absl::ascii_tolower(static_cast<unsigned char>(c)) - 'a' + 10;
}

}  // namespace

bool IsGlb(const std::string& bytes) { return absl::StartsWith(bytes, "glTF"); }

absl::StatusOr<absl::string_view> FindJsonText(const std::string& bytes) {
  absl::StatusOr<absl::string_view> text = absl::string_view(bytes);
  if (IsGlb(bytes)) text = FindGlbJson(bytes);
  if (text.ok() && NestingDepth(*text) > kMaxJsonDepth) {
    return SceneError("JSON", absl::StrCat("it is nested deeper than ", kMaxJsonDepth, " levels"),
                      "remove the deep extras or extensions");
  }
  return text;
}

absl::StatusOr<std::vector<Warning>> CheckContainer(const std::string& bytes) {
  std::vector<Warning> warnings;
  if (!IsGlb(bytes)) return warnings;
  bool is_aligned = true;
  absl::Status status = CheckChunks(bytes, &is_aligned);
  if (!status.ok()) return status;
  if (!is_aligned) {
    warnings.push_back({"GLB_CHUNK_ALIGNMENT", "a chunk's length is no multiple of 4"});
  }
  if (const uint64_t length = ReadU32(bytes, 8); length < bytes.size()) {
    warnings.push_back(
        {"GLB_TRAILING_DATA",
         absl::StrCat(bytes.size() - length, " bytes after its end were passed over")});
  }
  return warnings;
}

std::string DecodeUri(const std::string& uri) {
  std::string decoded;
  for (size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size() && HexValue(uri[i + 1]) >= 0 &&
        HexValue(uri[i + 2]) >= 0) {
      decoded += static_cast<char>(HexValue(uri[i + 1]) * 16 + HexValue(uri[i + 2]));
      i += 2;
    } else {
      decoded += uri[i];
    }
  }
  return decoded;
}

bool IsSafeRelativeUri(const std::string& uri) {
  for (const std::string& text : {uri, DecodeUri(uri)}) {
    if (text.empty() || text[0] == '/') return false;
    for (char c : text) {
      if (c == '\\' || c == ':' || absl::ascii_iscntrl(static_cast<unsigned char>(c))) return false;
    }
    for (absl::string_view part : absl::StrSplit(text, '/')) {
      if (part == "..") return false;
    }
  }
  return true;
}

std::string Printable(const std::string& text) {
  std::string printable = text.substr(0, kMaxQuotedBytes);
  for (char& c : printable) {
    if (!absl::ascii_isprint(static_cast<unsigned char>(c))) c = absl::ascii_isspace(c) ? ' ' : '?';
  }
  return text.size() > kMaxQuotedBytes ? printable + "..." : printable;
}

}  // namespace lambert

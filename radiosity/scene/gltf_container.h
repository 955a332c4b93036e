// The outside of a glTF file: its JSON text, found and checked before anything parses it.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "radiosity/core/warning.h"

namespace lambert {

// True for bytes that begin like a GLB file; everything else is taken as JSON text.
bool IsGlb(const std::string& bytes);

// The JSON text inside `bytes`, which must outlive it: the whole of a .gltf, the first chunk of a
// GLB. SceneError for a GLB of another version or whose lengths lie, and for text nested so deep
// that a recursive parser could not follow.
absl::StatusOr<absl::string_view> FindJsonText(const std::string& bytes);

// Checks the chunks of a GLB: SceneError where one runs past the end or there are two of one type.
// Warns of chunks that are not aligned (GLB_CHUNK_ALIGNMENT) and of bytes after the end
// (GLB_TRAILING_DATA). Requires: FindJsonText(bytes) is OK.
absl::StatusOr<std::vector<Warning>> CheckContainer(const std::string& bytes);

// A URI with its %xx sequences decoded.
std::string DecodeUri(const std::string& uri);

// True for a relative URI that stays inside the folder of its scene: no scheme, no leading slash,
// no "..", no backslash and no control character, before and after decoding.
bool IsSafeRelativeUri(const std::string& uri);

// Text of a file as it may stand in a message: one line of printable ASCII, not long.
std::string Printable(const std::string& text);

}  // namespace lambert

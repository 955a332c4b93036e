// What glTF allows and the parser does not: put in words that it reads.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace lambert {

// True for a buffer that only stands in for compressed data (EXT_meshopt_compression, `fallback`):
// it has no bytes that are read.
bool IsFallbackBuffer(const nlohmann::json& buffer);

struct AmendedGltf {
  std::string bytes;
  std::vector<size_t> without_view;  // accessors that name buffer view 0 here, and none in truth
};

// The file with skins that leave their inverse bind matrices out naming accessor -1, with animated
// targets that leave their node out (KHR_animation_pointer) naming node -1, with primitives that
// Draco compressed without indices of their own, with fallback buffers of one byte, and with a
// buffer view for sparse indices that have none; nullopt where nothing is to be changed. Requires:
// a file whose FindJsonText is ok.
std::optional<AmendedGltf> AmendGltf(const std::string& main_bytes);

}  // namespace lambert

// What glTF allows and the parser does not: put in words that it reads.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace lambert {

// True for a buffer that only stands in for compressed data (EXT_meshopt_compression, `fallback`):
// it has no bytes that are read.
bool IsFallbackBuffer(const nlohmann::json& buffer);

// The file with skins that leave their inverse bind matrices out naming accessor -1, with
// primitives that Draco compressed without indices of their own, and with fallback buffers of one
// byte; nullopt where nothing is to be changed. Requires: a file whose FindJsonText is ok.
std::optional<std::string> AmendGltf(const std::string& main_bytes);

}  // namespace lambert

// How large a result may be.
#pragma once

#include <cstdint>

namespace lambert::server {

// Most bytes of an encoded result over so many patches (docs/formats.md, "unit result"). 96 a
// patch: what arrived there, and what came to rest at two places (radiosity/patch/surface_tree.h).
// `rays`: of the step.
inline int64_t MaxResultBytes(int64_t patches, int64_t rays, bool has_sightings) {
  constexpr int64_t kHeaderBytes = 1024, kPatchBytes = 96, kSightingBytes = 64;
  return kHeaderBytes + kPatchBytes * patches + (has_sightings ? kSightingBytes * rays : 0);
}

}  // namespace lambert::server

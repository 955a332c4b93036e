// What every fuzzed decoder has in common: FuzzOne is given bytes that libFuzzer made, in
// TARGET_fuzz.cc of this folder. It must neither crash, nor hang, nor take much memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace lambert {

void FuzzOne(const std::string& bytes);

// Ends the run, which libFuzzer counts as a finding.
inline void Expect(bool holds, const char* claim) {
  if (holds) return;
  std::fprintf(stderr, "this does not hold: %s\n", claim);
  std::abort();
}

}  // namespace lambert

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  lambert::FuzzOne(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

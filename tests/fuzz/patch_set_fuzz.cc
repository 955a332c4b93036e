#include "radiosity/patch/patch_set.h"
#include "tests/fuzz/fuzz.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  const absl::StatusOr<PatchSet> patches = DecodePatchSet(bytes);
  if (patches.ok()) Expect(EncodePatchSet(*patches) == bytes, "a patch set has one encoding");
}

}  // namespace lambert

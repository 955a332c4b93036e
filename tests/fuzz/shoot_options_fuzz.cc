#include "radiosity/shoot/options_codec.h"
#include "tests/fuzz/fuzz.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  const absl::StatusOr<ShootOptions> options = DecodeShootOptions(bytes);
  if (options.ok()) Expect(EncodeShootOptions(*options) == bytes, "options have one encoding");
}

}  // namespace lambert

#include "radiosity/solve/solution.h"
#include "tests/fuzz/fuzz.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  const absl::StatusOr<Solution> solution = DecodeSolution(bytes);
  if (solution.ok()) Expect(EncodeSolution(*solution) == bytes, "a solution has one encoding");
}

}  // namespace lambert

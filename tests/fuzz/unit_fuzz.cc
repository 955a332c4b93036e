#include "radiosity/shoot/unit.h"
#include "tests/fuzz/fuzz.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  const absl::StatusOr<WorkUnit> unit = DecodeUnit(bytes);
  if (!unit.ok()) return;
  Expect(EncodeUnit(*unit) == bytes, "a unit has one encoding");
  Expect(unit->RayCount() >= 0, "rays are counted");
}

}  // namespace lambert

// A worker's result on its way into a step: decoded, held against its unit, merged.
#include "radiosity/shoot/unit.h"
#include "tests/fuzz/fuzz.h"

namespace lambert {

void FuzzOne(const std::string& bytes) {
  constexpr PatchIndex kPatches = 32;
  const absl::StatusOr<UnitResult> result = DecodeUnitResult(bytes, kPatches);
  if (!result.ok()) return;
  Expect(EncodeUnitResult(*result) == bytes, "a result has one encoding");
  for (const Deposit& deposit : result->deposits) {
    Expect(deposit.patch >= 0 && deposit.patch < kPatches, "deposits are at patches");
  }
  WorkUnit unit;
  unit.visits.push_back({0, 1000, 0, 1000, {1 << 20, 1 << 20, 1 << 20}});
  for (const double rays_per_m2 : {0., 10.}) {
    unit.rays_per_m2 = rays_per_m2;
    CheckLedger(unit, *result).IgnoreError();
  }
  UnitResult merged = *result;
  MergeResult(*result, merged);
}

}  // namespace lambert

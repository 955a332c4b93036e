// Unit results as tests like to read them.
#pragma once

#include <vector>

#include "radiosity/shoot/unit.h"

namespace lambert {

// Deposits by patch, of no hits where nothing arrived.
inline std::vector<Deposit> ByPatch(const UnitResult& result, PatchIndex patch_count) {
  std::vector<Deposit> deposits(patch_count);
  for (PatchIndex i = 0; i < patch_count; ++i) deposits[i].patch = i;
  for (const Deposit& deposit : result.deposits) deposits[deposit.patch] = deposit;
  return deposits;
}

}  // namespace lambert

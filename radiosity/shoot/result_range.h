// A result cut by patches: merge shards take a range each, and the ledger goes by itself.
#pragma once

#include "radiosity/shoot/unit.h"

namespace lambert {

// What a result tells of the patches [begin, end): what arrived there, what came to rest at the
// places [2 begin, 2 end) and what was seen from there. Of the ledger only the channels; rays 0.
// Ranges that cover all patches once cover a result once.
UnitResult RangeOf(const UnitResult& result, PatchIndex begin, PatchIndex end);

// The ledger of a result alone: shot, escaped, rays, channels and processor time.
UnitResult LedgerOf(const UnitResult& result);

// True where a result tells of these patches only, in the sense of RangeOf, and has no ledger.
bool IsRange(const UnitResult& result, PatchIndex begin, PatchIndex end);

// CheckLedger (unit.h) of the sum of units like `any`, of one step, that have so many rays
// together.
absl::Status CheckLedger(const WorkUnit& any, int64_t rays, const UnitResult& result);

// Puts a range behind those before it. Requires: `into` tells of patches before `range` only.
void AppendRange(const UnitResult& range, UnitResult& into);

}  // namespace lambert

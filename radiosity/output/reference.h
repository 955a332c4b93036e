// The solution that errors are measured against, and how far it may be off itself.
#pragma once

#include <set>

#include "absl/status/statusor.h"
#include "radiosity/output/compare.h"
#include "radiosity/output/patch_table.h"

namespace lambert {

struct Reference {
  PatchTable table;
  ErrorMeasures residual;  // expected error of the table itself; its rms_* only
};

// The mean of two independent halves of equal effort. Their difference tells its residual: it has
// twice the standard deviation of their mean, so the residual is rms(a - b) / 2. Fails where
// the region has no patch. Requires: both are of one patch set.
absl::StatusOr<Reference> JoinHalves(const PatchTable& a, const PatchTable& b,
                                     const std::set<int>& region_nodes);

// A table from a file: the residual is what its own std_error says (0 where it is exact or was not
// told; none where it is not known). Channels are taken as wholly correlated: one ray carries all
// three.
absl::StatusOr<Reference> JudgeReference(PatchTable table, const std::set<int>& region_nodes);

}  // namespace lambert

// How far a solution is from a reference: the error measures of docs/formats.md.
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/output/patch_table.h"

namespace lambert {

// Ratios to the area-weighted mean reflected radiosity of the reference; RGB taken as its mean.
// Empty where undefined: the reference reflects no light, or no region was named.
struct ErrorMeasures {
  std::optional<double> rms_area;    // weighted by area
  std::optional<double> rms_patch;   // every patch counts the same
  std::optional<double> rms_local;   // rms_patch of the region, over the region's own mean
  std::optional<double> p95;         // 95th percentile of a patch's relative error
  std::optional<double> power_bias;  // reflected flux over the reference's, minus 1
};

// For every patch of `table` its partner in `reference`: by index where both tables have equally
// many with equal areas, else by origin (node, mesh, primitive, triangle) and corners.
// INVALID_ARGUMENT (reason TABLES_DIFFER) where patches have no partner.
absl::StatusOr<std::vector<PatchIndex>> PairPatches(const PatchTable& table,
                                                    const PatchTable& reference);

// `region_nodes` are glTF node indices. Fails as PairPatches does, and with NOT_FOUND (reason
// REGION_EMPTY) where a region is named that has no patch.
absl::StatusOr<ErrorMeasures> Compare(const PatchTable& table, const PatchTable& reference,
                                      const std::set<int>& region_nodes = {});

}  // namespace lambert

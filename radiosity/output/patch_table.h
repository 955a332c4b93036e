// patches.csv: a solution as one line a patch, in full double precision (docs/formats.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solution.h"

namespace lambert {

// The columns of patches.csv, all of the same length, by patch.
struct PatchTable {
  std::vector<PatchSource> source;
  std::vector<double> area_m2;
  std::vector<std::array<Vec3, 3>> corners;  // world metres
  std::vector<Rgb> reflectance;
  std::vector<Rgb> exitance_lm_per_m2, radiosity_lm_per_m2;
  std::vector<Rgb> irradiance_lx;
  std::vector<Rgb> std_error_lm_per_m2;  // of the radiosity

  PatchIndex size() const { return static_cast<PatchIndex>(source.size()); }
};

// Requires: the solution is about these patches.
PatchTable MakePatchTable(const PatchSet& patches, const Solution& solution);

// Writes `path` whole or not at all. Numbers are the shortest that read back to the same bits.
absl::Status WritePatchTable(const std::string& path, const PatchTable& table);

// Reads what WritePatchTable wrote, and tables of other programs with the same column names:
// columns may stand in any order, further columns are passed over. NOT_FOUND where there is no such
// file, INVALID_ARGUMENT (reason TABLE_INVALID) naming line and column where it cannot be read.
absl::StatusOr<PatchTable> ReadPatchTable(const std::string& path);

}  // namespace lambert

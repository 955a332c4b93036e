// Error measures against a reference, for --reference and --region.
#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/output/compare.h"
#include "radiosity/output/patch_table.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solution.h"

namespace lambert::app {

// Node indices for what --region names: a node's name (all nodes of that name), else its glTF
// index. USAGE for one that the scene does not have, with the nearest name.
absl::StatusOr<std::set<int>> FindRegions(const std::vector<std::string>& regions,
                                          const std::vector<std::string>& node_names);

// A reference that was read once. One thread.
class Measurer {
 public:
  // An empty path: nothing is measured. The file is read here, so that a wrong one is told early.
  static absl::StatusOr<Measurer> Create(const std::string& reference_path,
                                         const std::vector<std::string>& regions);

  bool wanted() const { return reference_.has_value(); }

  // Fails where the patches are not those of the reference. Requires: wanted().
  absl::StatusOr<ErrorMeasures> Measure(const PatchSet& patches, const Solution& solution) const;

 private:
  std::optional<PatchTable> reference_;
  std::vector<std::string> regions_;
};

}  // namespace lambert::app

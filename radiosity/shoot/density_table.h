// The pyramid densities of the patches that shoot enough to gain from them, computed when first
// needed and kept.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/pyramid/cluster_tree.h"
#include "radiosity/pyramid/hemisphere.h"
#include "radiosity/shoot/options.h"

namespace lambert {

// Rays that a patch must shoot in one visit for its densities to be worth computing, where
// `options.min_rays` leaves the choice open: computing them then costs about a tenth of tracing.
int64_t MinRaysForDensities(const PatchSet& patches, const PyramidOptions& options);

// Any number of threads at once.
class DensityTable {
 public:
  DensityTable(const PatchSet& patches, const PyramidOptions& options);
  ~DensityTable();
  DensityTable(const DensityTable&) = delete;
  DensityTable& operator=(const DensityTable&) = delete;

  const Hemisphere& hemisphere() const { return hemisphere_; }
  int64_t min_rays() const { return min_rays_; }
  // Densities of a patch: a function of the patch set and the options alone.
  std::vector<float> Get(PatchIndex patch) const;

 private:
  std::vector<float> Compute(PatchIndex patch) const;

  const PatchSet& patches_;
  const PyramidOptions options_;
  const int64_t min_rays_;
  const Hemisphere hemisphere_;
  const ClusterTree clusters_;
  // Filled once each; never replaced. Past kCacheBytes densities are computed at every visit.
  mutable std::vector<std::atomic<const std::vector<float>*>> kept_;
  mutable std::atomic<int64_t> kept_bytes_ = 0;
};

}  // namespace lambert

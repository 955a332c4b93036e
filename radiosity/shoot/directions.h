// The directions that each patch prefers: computed when first needed, and kept.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/patch/surface_tree.h"
#include "radiosity/pyramid/cluster_tree.h"
#include "radiosity/pyramid/target_tree.h"
#include "radiosity/shoot/cell_sampler.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/options.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// Whether densities count the patches in each pyramid (ClusterTree): those of the methods phs* by
// the rule of counts.
bool CountsPatches(const ShootOptions& options);

// Rays that a patch must shoot in one visit for its densities to be worth computing, where
// `min_rays` leaves the choice open: computing them then costs about a tenth of tracing.
int64_t MinRaysForDensities(const PatchSet& patches, const ShootOptions& options);

// What flux that arrives at each patch adds to the variance of the error measure `metric`:
// rho_j^2 A_j^(metric - 2), times the mean area to the power that makes it a number.
std::vector<double> ErrorWorth(const PatchSet& patches, double metric);

// Whether a direction table reads its patch set as long as it lives, and not only while it is made.
bool ReadsPatches(const ShootOptions& options);

// Any number of threads at once.
class DirectionTable {
 public:
  // `scene`, `emitters` and `tree` (null: none) are of `patches`; they must outlive the table, the
  // patches where ReadsPatches(options). `hit_worth`: of flux that arrives at each patch, for the
  // rule of least variance; may be empty for the rule of counts. Requires:
  // UsesPyramids(options.method).
  DirectionTable(const PatchSet& patches, const RayScene& scene, const Emitters& emitters,
                 const ShootOptions& options, std::vector<double> hit_worth,
                 const SurfaceTree* tree = nullptr);
  ~DirectionTable();
  DirectionTable(const DirectionTable&) = delete;
  DirectionTable& operator=(const DirectionTable&) = delete;

  const CellSampler& sampler() const { return sampler_; }
  // Whose directions the rays of a patch follow, a place of the tree: the patch's own where the
  // visit has MinRaysForDensities; else those of the smallest element around it that shoots as many
  // where `rays_per_m2` start; kNoPatch where none does.
  PatchIndex PlaceFor(const Visit& visit, double rays_per_m2) const;
  const std::vector<double>& hit_worth() const { return hit_worth_; }
  // The densities of f_p: those of cells that are all worth nothing.
  const Directions& by_flux() const { return by_flux_; }
  // Of a patch or a place: a function of the patch set and the options alone. Lives as long as the
  // table and the pointer.
  std::shared_ptr<const Directions> Get(PatchIndex place) const;
  // Densities from what each cell is worth, by the options' weights.
  Directions FromWorth(const std::vector<double>& worth) const;

 private:
  Directions Compute(PatchIndex place) const;
  std::vector<double> Worth(PatchIndex place) const;
  LocalFrame Frame(PatchIndex place) const;
  const ClusterTree& Clusters() const;

  const RayScene& scene_;
  const Emitters& emitters_;
  const SurfaceTree* const tree_;
  const ShootOptions options_;
  const std::vector<double> hit_worth_;
  const int64_t min_rays_;
  const CellSampler sampler_;
  const Directions by_flux_;
  const bool counts_;          // patches in cells
  PatchSet corners_;           // of the patches, and nothing else, where that will do
  const PatchSet& patches_;    // they or `corners_`
  std::vector<bool> counted_;  // for the clusters, which are made for the first densities: there
  mutable std::once_flag clusters_once_;  // may be none in large scenes
  mutable std::unique_ptr<const ClusterTree> clusters_;
  // For least variance.
  std::unique_ptr<const TargetTree> targets_;
  // Filled once each; never replaced. Past kCacheBytes densities are computed at every visit.
  mutable std::vector<std::atomic<const Directions*>> kept_;
  mutable std::atomic<int64_t> kept_bytes_ = 0;
};

}  // namespace lambert

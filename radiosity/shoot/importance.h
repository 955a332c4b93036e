// What light on each patch is worth to a region of interest (NNB96), and what the rays of each
// patch are worth.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/emitter.h"
#include "radiosity/shoot/options.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// 1 for the patches of the named nodes, 0 for others. A node is a name or a glTF index.
// FIELD_INVALID naming the nodes there are, for one that has no patch.
absl::StatusOr<std::vector<uint8_t>> RegionPatches(const PatchSet& patches,
                                                   const std::vector<std::string>& region);

// FIELD_INVALID where options that are valid do not fit this scene: too many patches for the
// method, or a region that it does not have.
absl::Status ValidateFor(const PatchSet& patches, const ShootOptions& options);

// W of each patch: the solution of the dual system  W_j = V_j + rho_j sum_k F_jk W_k  with V = 1 in
// the region, by shooting about 200,000 rays: a function of the patch set and the region alone.
std::vector<double> RegionImportance(const PatchSet& patches, const RayScene& scene,
                                     const Emitters& emitters,
                                     const std::vector<uint8_t>& in_region);

// What flux that arrives at each patch is worth to the error that `options` mean to lower: its
// importance for the region, squared, or ErrorWorth of the metric.
absl::StatusOr<std::vector<double>> HitWorth(const PatchSet& patches, const RayScene& scene,
                                             const Emitters& emitters, const ShootOptions& options);

// Rays that each patch should get for a lumen of its flux, by sum_p f_p sqrt(S_p): of mean 1 over
// the patches' emission; empty where all get the same: by flux, and the method is not importance. A
// tenth of the mean at least.
absl::StatusOr<std::vector<double>> AllocationWeights(const PatchSet& patches,
                                                      const ShootOptions& options);

}  // namespace lambert

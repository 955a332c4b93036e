// Probing rays: what stands in each part of a patch's hemisphere, seen instead of computed (JP97,
// JP98).
#pragma once

#include <vector>

#include "radiosity/shoot/cell_sampler.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

struct ProbeOptions {
  DensityRule rule = DensityRule::kCount;
  const std::vector<double>* hit_worth = nullptr;  // of each patch, for the rule of least variance
};

// Shoots rays_of_cell[p] rays from a patch through each cell p of `sampler` and returns the worth
// of each cell: the patches that were hit, each once (rule count), or f_p sqrt(S_p) with S_p the
// mean worth of its rays (rule variance); 0 where nothing was shot.
std::vector<double> ProbeWorth(const CellSampler& sampler, const RayScene& scene,
                               const EmitterFrame& frame, const RayNumbers& numbers,
                               const std::vector<uint32_t>& rays_of_cell,
                               const ProbeOptions& options);

}  // namespace lambert

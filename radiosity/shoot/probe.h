// Probing rays: what stands in each part of a patch's hemisphere, seen instead of computed (JP97,
// JP98).
#pragma once

#include <functional>
#include <vector>

#include "radiosity/shoot/cell_sampler.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

struct ProbeOptions {
  DensityRule rule = DensityRule::kCount;
  const std::vector<double>* hit_worth = nullptr;  // of each patch, for the rule of least variance
};

// Shoots `rays` rays from a patch, divided over the cells of `sampler` by `rays_of_cell`, and
// returns the worth of each cell: the patches that were hit, each once (rule count), or f_p
// sqrt(S_p) with S_p the mean worth of the hits (rule variance; where nothing was shot: of all
// cells). `on_hit(ray, cell, hit)` is called for every ray in order, if given.
std::vector<double> ProbeWorth(
    const CellSampler& sampler, const RayScene& scene, const EmitterFrame& frame,
    const RayNumbers& numbers, const std::vector<uint32_t>& rays_of_cell,
    const ProbeOptions& options,
    const std::function<void(uint32_t ray, int32_t cell, PatchIndex hit)>& on_hit);

}  // namespace lambert

// Probing rays: what stands in each part of a patch's hemisphere, seen instead of computed (JP97,
// JP98).
#pragma once

#include <vector>

#include "absl/types/span.h"
#include "radiosity/shoot/cell_sampler.h"
#include "radiosity/shoot/flight.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

struct ProbeOptions {
  DensityRule rule = DensityRule::kCount;
  const std::vector<double>* hit_worth = nullptr;  // of each patch, for the rule of least variance
};

// The worth of each cell by what rays from one patch through it hit: the patches that were hit,
// each once (rule count), or f_p sqrt(S_p) with S_p the mean worth of its rays (rule variance); 0
// where nothing was shot. `fractions`: f_p of each cell. Requires: hits in the order of their
// cells.
std::vector<double> WorthOfHits(absl::Span<const CellHit> hits,
                                const std::vector<double>& fractions, const ProbeOptions& options);

// The same of `rays` rays that are shot from a patch through each cell of `sampler`, and carry
// nothing.
std::vector<double> ProbeWorth(const CellSampler& sampler, const RayScene& scene,
                               const Emitters& emitters, PatchIndex patch,
                               const RandomStream& stream, int rays, const ProbeOptions& options);

}  // namespace lambert

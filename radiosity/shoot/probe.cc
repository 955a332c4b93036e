#include "radiosity/shoot/probe.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace lambert {
namespace {

double DistinctHits(std::vector<PatchIndex>& hits) {
  std::sort(hits.begin(), hits.end());
  return static_cast<double>(std::unique(hits.begin(), hits.end()) - hits.begin());
}

double MeanWorth(const std::vector<PatchIndex>& hits, uint32_t rays,
                 const std::vector<double>& worth) {
  double sum = 0;
  for (PatchIndex hit : hits) sum += worth[hit];
  return sum / rays;
}

}  // namespace

std::vector<double> ProbeWorth(const CellSampler& sampler, const RayScene& scene,
                               const EmitterFrame& frame, const RayNumbers& numbers,
                               const std::vector<uint32_t>& rays_of_cell,
                               const ProbeOptions& options) {
  std::vector<int32_t> cells;
  for (size_t p = 0; p < rays_of_cell.size(); ++p) {
    cells.insert(cells.end(), rays_of_cell[p], static_cast<int32_t>(p));
  }
  std::vector<std::vector<PatchIndex>> hits(rays_of_cell.size());
  auto batch = std::make_unique<RayBatch>();
  float weight[RayBatch::kSlots];
  const auto total = static_cast<uint32_t>(cells.size());
  for (uint32_t begin = 0; begin < total; begin += RayBatch::kCapacity) {
    const uint32_t end = std::min<uint32_t>(total, begin + RayBatch::kCapacity);
    batch->size = 0;
    sampler.Append(frame, {}, cells.data() + begin, numbers, begin, end, *batch, weight);
    scene.Trace(*batch);
    for (uint32_t ray = begin; ray < end; ++ray) {
      const PatchIndex hit = batch->hit[ray - begin];
      if (hit >= 0) hits[cells[ray]].push_back(hit);
    }
  }
  std::vector<double> worth(hits.size());
  for (size_t p = 0; p < hits.size(); ++p) {
    if (options.rule == DensityRule::kCount) {
      worth[p] = DistinctHits(hits[p]);
    } else if (rays_of_cell[p] > 0) {
      worth[p] = sampler.fractions()[p] *
                 std::sqrt(MeanWorth(hits[p], rays_of_cell[p], *options.hit_worth));
    }
  }
  return worth;
}

}  // namespace lambert

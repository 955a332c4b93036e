#include "radiosity/shoot/probe.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "radiosity/shoot/volley.h"

namespace lambert {

std::vector<double> WorthOfHits(absl::Span<const CellHit> hits,
                                const std::vector<double>& fractions, const ProbeOptions& options) {
  std::vector<double> worth(fractions.size());
  std::vector<PatchIndex> seen;  // through one cell
  for (size_t begin = 0, end = 0; begin < hits.size(); begin = end) {
    const int32_t cell = hits[begin].cell;
    seen.clear();
    for (; end < hits.size() && hits[end].cell == cell; ++end) {
      if (hits[end].hit >= 0) seen.push_back(hits[end].hit);
    }
    if (options.rule == DensityRule::kCount) {
      std::sort(seen.begin(), seen.end());
      worth[cell] = static_cast<double>(std::unique(seen.begin(), seen.end()) - seen.begin());
    } else {
      double sum = 0;
      for (PatchIndex patch : seen) sum += (*options.hit_worth)[patch];
      worth[cell] = fractions[cell] * std::sqrt(sum / static_cast<double>(end - begin));
    }
  }
  return worth;
}

std::vector<double> ProbeWorth(const CellSampler& sampler, const RayScene& scene,
                               const Emitters& emitters, PatchIndex patch,
                               const RandomStream& stream, int rays, const ProbeOptions& options) {
  Arrivals nothing_arrives(0);
  UnitResult result;
  std::vector<CellHit> hits;
  auto flight = std::make_unique<Flight>(scene, nothing_arrives, result, /*watch=*/false);
  flight->RecordHits(&hits);
  Volley volley(emitters, &sampler, stream, Sequence::kRandom, *flight);
  uint32_t ray = 0;
  for (int cell = 0; cell < sampler.cells().size(); ++cell) {
    const SphericalTriangle* pyramid = sampler.Pyramid({}, cell);
    for (int k = 0; k < rays; ++k) volley.ShootThrough(cell, pyramid, patch, ray++, Long4{});
  }
  volley.Finish();
  flight->Land();
  return WorthOfHits(hits, sampler.fractions(), options);
}

}  // namespace lambert

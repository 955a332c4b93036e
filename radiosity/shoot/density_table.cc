#include "radiosity/shoot/density_table.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "radiosity/pyramid/density.h"

namespace lambert {
namespace {

constexpr int64_t kCacheBytes = int64_t{256} << 20;

}  // namespace

int64_t MinRaysForDensities(const PatchSet& patches, const PyramidOptions& options) {
  if (options.min_rays > 0) return options.min_rays;
  // Measured (docs/benchmarks.md): counting takes 11 ns a patch of the scene, a ray 250 ns. Kept
  // densities also serve the passes to come, which shoot about twice as many rays again.
  constexpr double kCountNsPerPatch = 11, kRayNs = 250, kShareOfTime = 0.1, kVisitsServed = 3;
  const double pyramids = options.initial * std::pow(options.split, options.depth);
  const double rays = kCountNsPerPatch * patches.size() / (kRayNs * kShareOfTime * kVisitsServed);
  return std::llround(std::max(pyramids, rays));
}

DensityTable::DensityTable(const PatchSet& patches, const PyramidOptions& options)
    : patches_(patches),
      options_(options),
      min_rays_(MinRaysForDensities(patches, options)),
      hemisphere_(options.initial, options.split, options.depth),
      clusters_(patches, options.count_black),
      kept_(patches.size()) {}

DensityTable::~DensityTable() {
  for (auto& slot : kept_) delete slot.load();
}

std::vector<float> DensityTable::Compute(PatchIndex patch) const {
  const std::vector<int32_t> counts =
      clusters_.CountPatches(PatchFrame(patches_, patch), hemisphere_, options_.use_clusters);
  return PyramidDensities(hemisphere_, counts, options_.alpha1, options_.alpha2);
}

std::vector<float> DensityTable::Get(PatchIndex patch) const {
  std::atomic<const std::vector<float>*>& slot = kept_[patch];
  if (const std::vector<float>* kept = slot.load(std::memory_order_acquire)) return *kept;
  std::vector<float> densities = Compute(patch);
  const int64_t bytes = static_cast<int64_t>(densities.size() * sizeof(float));
  if (kept_bytes_.fetch_add(bytes) + bytes <= kCacheBytes) {
    auto copy = std::make_unique<const std::vector<float>>(densities);
    const std::vector<float>* expected = nullptr;
    if (slot.compare_exchange_strong(expected, copy.get(), std::memory_order_acq_rel)) {
      copy.release();
    }
  }
  return densities;
}

}  // namespace lambert

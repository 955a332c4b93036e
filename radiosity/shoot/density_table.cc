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
  // Measured (docs/benchmarks.md): counting opens about 40 pyramids^(1/2) log2(patches) clusters
  // of 150 ns each, or tests every vertex; a ray takes 250 ns.
  const double patch_count = std::max<double>(2, patches.size());
  const double pyramids = options.initial * std::pow(options.split, options.depth);
  const double all_ns = 60 * patch_count;
  const double clustered_ns = 150 * 40 * std::sqrt(pyramids) * std::log2(patch_count) / 4;
  const double density_ns = options.use_clusters ? std::min(all_ns, clustered_ns) : all_ns;
  return std::max<int64_t>(static_cast<int64_t>(pyramids),
                           static_cast<int64_t>(density_ns / 25));
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

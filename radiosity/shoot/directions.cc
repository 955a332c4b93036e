#include "radiosity/shoot/directions.h"

#include <algorithm>
#include <cmath>

#include "radiosity/pyramid/density.h"
#include "radiosity/shoot/probe.h"

namespace lambert {
namespace {

constexpr double kRayNs = 250;  // a ray, all in all
constexpr int64_t kCacheBytes = int64_t{256} << 20;
// Angle [rad] under which targets are taken as points: this share of a cell's width.
constexpr double kOpeningShare = 0.6;

bool TakesLeastVariance(const ShootOptions& options) {
  return options.pyramids.rule == DensityRule::kVariance || options.method == Method::kImportance;
}

bool Probes(const ShootOptions& options) {
  return options.method == Method::kHs97 || options.method == Method::kHs98;
}

// Measured (docs/benchmarks.md): counting takes 8 to 13 ns a patch of the scene, least variance 1.0
// to 1.9 us a cell.
double DensityNs(const PatchSet& patches, const ShootOptions& options) {
  constexpr double kCountNs = 11, kCellNs = 1500;
  const double cells = options.pyramids.CellCount();
  if (options.method == Method::kHs98) return cells * options.pyramids.probes * kRayNs;
  if (TakesLeastVariance(options)) return cells * kCellNs;
  return patches.size() * kCountNs;
}

}  // namespace

bool CountsPatches(const ShootOptions& options) {
  return UsesPyramids(options.method) && !Probes(options) && !TakesLeastVariance(options);
}

bool ReadsPatches(const ShootOptions& options) {
  return TakesLeastVariance(options) || options.method == Method::kPhsHier;
}

int64_t MinRaysForDensities(const PatchSet& patches, const ShootOptions& options) {
  const PyramidOptions& pyramids = options.pyramids;
  if (pyramids.min_rays > 0) return pyramids.min_rays;
  const int64_t cells = pyramids.CellCount();
  // Half of the rays probe, the others follow.
  if (options.method == Method::kHs97) return 2 * cells * pyramids.probes;
  // Kept densities also serve the passes to come, which shoot about twice as many rays again.
  constexpr double kShareOfTime = 0.1, kVisitsServed = 3;
  const double rays = DensityNs(patches, options) / (kRayNs * kShareOfTime * kVisitsServed);
  return std::max(cells, static_cast<int64_t>(std::llround(rays)));
}

std::vector<double> ErrorWorth(const PatchSet& patches, double metric) {
  double area = 0;
  for (double a : patches.area_m2) area += a;
  const double mean = area / std::max<PatchIndex>(1, patches.size());
  std::vector<double> worth(patches.size());
  for (PatchIndex j = 0; j < patches.size(); ++j) {
    const double rho = Mean(patches.reflectance[j]);
    worth[j] = rho * rho * std::pow(patches.area_m2[j] / mean, metric - 2);
  }
  return worth;
}

DirectionTable::DirectionTable(const PatchSet& patches, const RayScene& scene,
                               const Emitters& emitters, const ShootOptions& options,
                               std::vector<double> hit_worth, const SurfaceTree* tree)
    : scene_(scene),
      emitters_(emitters),
      tree_(tree),
      options_(options),
      hit_worth_(std::move(hit_worth)),
      min_rays_(MinRaysForDensities(patches, options)),
      sampler_(options.pyramids),
      by_flux_(FromWorth(std::vector<double>(sampler_.fractions().size()))),
      counts_(CountsPatches(options)),
      patches_(ReadsPatches(options) ? patches : corners_),
      kept_(tree != nullptr ? tree->place_count() : patches.size()) {
  if (counts_) {
    const PartSet with = options.parts.with;
    counted_ = CountedPatches(patches, with.Has(Part::kBlack), with.Has(Part::kUnlit));
    if (!ReadsPatches(options)) corners_.corners = patches.corners;
  } else if (!Probes(options)) {
    targets_ = std::make_unique<TargetTree>(patches, hit_worth_);
  }
}

DirectionTable::~DirectionTable() {
  for (auto& slot : kept_) delete slot.load();
}

PatchIndex DirectionTable::PlaceFor(const Visit& visit, double rays_per_m2) const {
  if (visit.ray_count >= min_rays_) return visit.emitter;
  if (tree_ == nullptr) return kNoPatch;
  for (int32_t e = tree_->ParentOf(visit.emitter); e >= 0; e = tree_->elements()[e].parent) {
    const double rays = rays_per_m2 * tree_->elements()[e].area_m2;
    if (rays >= static_cast<double>(min_rays_)) return tree_->PlaceOf(e);
  }
  return kNoPatch;
}

const ClusterTree& DirectionTable::Clusters() const {
  std::call_once(clusters_once_, [this] {
    clusters_ = std::make_unique<const ClusterTree>(patches_.corners, counted_);
  });
  return *clusters_;
}

LocalFrame DirectionTable::Frame(PatchIndex place) const {
  return tree_ != nullptr ? PlaceFrame(patches_, *tree_, place) : PatchFrame(patches_, place);
}

std::vector<double> DirectionTable::Worth(PatchIndex place) const {
  const HemisphereCells& cells = sampler_.cells();
  if (targets_ != nullptr) {
    const double opening =
        kOpeningShare * std::sqrt(2 * std::numbers::pi / static_cast<double>(cells.size()));
    return LeastVariance(sampler_.fractions(), targets_->Moments(Frame(place), cells, opening));
  }
  if (counts_) {
    const std::vector<int32_t> counts =
        Clusters().CountPatches(Frame(place), cells, !options_.parts.without.Has(Part::kClusters));
    return {counts.begin(), counts.end()};
  }
  // hs98: the probing rays are of no seed, so that the densities are those of the scene.
  const RandomStream stream{0, static_cast<uint32_t>(place), 0, 0};
  return ProbeWorth(sampler_, scene_, emitters_, place, stream, options_.pyramids.probes,
                    {options_.pyramids.rule, &hit_worth_});
}

Directions DirectionTable::FromWorth(const std::vector<double>& worth) const {
  return {CellSpans(CellDensities(sampler_.fractions(), worth, options_.pyramids.alpha1,
                                  options_.pyramids.alpha2)),
          {}};
}

Directions DirectionTable::Compute(PatchIndex place) const {
  const std::vector<double> worth = Worth(place);
  if (options_.method != Method::kPhsAdaptive) return FromWorth(worth);
  AdaptivePyramids split =
      SplitWhereWorthIs(sampler_.hemisphere(), worth, options_.pyramids.leaves);
  std::vector<double> fractions;
  for (const SphericalTriangle* pyramid : split.pyramids) {
    fractions.push_back(pyramid->flux_fraction());
  }
  return {CellSpans(CellDensities(fractions, split.worth, options_.pyramids.alpha1,
                                  options_.pyramids.alpha2)),
          std::move(split.pyramids)};
}

std::shared_ptr<const Directions> DirectionTable::Get(PatchIndex place) const {
  // Without an owner: no count to be shared by threads.
  const auto lent = [](const Directions* kept) {
    return std::shared_ptr<const Directions>(std::shared_ptr<void>(), kept);
  };
  std::atomic<const Directions*>& slot = kept_[place];
  if (const Directions* kept = slot.load(std::memory_order_acquire)) return lent(kept);
  auto directions = std::make_unique<const Directions>(Compute(place));
  const auto bytes = static_cast<int64_t>(directions->spans.size() * sizeof(uint32_t) +
                                          directions->pyramids.size() * sizeof(void*));
  if (kept_bytes_.fetch_add(bytes) + bytes > kCacheBytes) return directions;
  const Directions* expected = nullptr;
  const bool first =
      slot.compare_exchange_strong(expected, directions.get(), std::memory_order_acq_rel);
  return lent(first ? directions.release() : expected);
}

}  // namespace lambert

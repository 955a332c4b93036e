#include "radiosity/shoot/importance.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <set>

#include "radiosity/core/error.h"
#include "radiosity/pyramid/concentric_grid.h"
#include "radiosity/pyramid/density.h"
#include "radiosity/pyramid/target_tree.h"
#include "radiosity/shoot/directions.h"

namespace lambert {
namespace {

constexpr double kImportanceRays = 200'000;
constexpr int kImportanceSteps = 64;
constexpr double kUnsentImportance = 1e-3;  // of all: what is left does not matter
constexpr double kLeastWeight = 0.1;        // of the mean

std::string NodesOf(const PatchSet& patches) {
  constexpr size_t kShown = 20;
  std::set<int32_t> nodes;
  for (const PatchSource& source : patches.source) nodes.insert(source.node);
  std::string text;
  size_t shown = 0;
  for (int32_t node : nodes) {
    if (++shown > kShown) return text + ", ...";
    const bool named =
        static_cast<size_t>(node) < patches.node_names.size() && !patches.node_names[node].empty();
    text += (text.empty() ? "" : ", ") + (named ? patches.node_names[node] : std::to_string(node));
  }
  return text;
}

}  // namespace

absl::StatusOr<std::vector<uint8_t>> RegionPatches(const PatchSet& patches,
                                                   const std::vector<std::string>& region) {
  std::vector<uint8_t> inside(patches.size());
  for (const std::string& name : region) {
    const std::vector<int32_t> nodes = NodesCalled(patches.node_names, name);
    bool found = false;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      if (std::find(nodes.begin(), nodes.end(), patches.source[i].node) == nodes.end()) continue;
      inside[i] = 1;
      found = true;
    }
    if (!found) {
      return MakeError(absl::StatusCode::kInvalidArgument,
                       {"FIELD_INVALID", "region", "no patch is of a node '" + name + "'",
                        "name one of " + NodesOf(patches)});
    }
  }
  return inside;
}

absl::Status ValidateFor(const PatchSet& patches, const ShootOptions& options) {
  if (absl::Status status = options.ValidateFor(patches.size()); !status.ok()) return status;
  if (options.method == Method::kExact && HasSky(patches)) {
    return MakeError(
        absl::StatusCode::kInvalidArgument,
        {"FIELD_INVALID", "method", "exact does not take a sky", "use --method pmcr, or auto"});
  }
  if (options.method != Method::kImportance) return absl::OkStatus();
  return RegionPatches(patches, options.region).status();
}

std::vector<double> RegionImportance(const PatchSet& patches, const RayScene& scene,
                                     const Emitters& emitters,
                                     const std::vector<uint8_t>& in_region) {
  std::vector<double> unsent(patches.size()), importance(patches.size());
  double emitted = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    importance[i] = in_region[i];
    unsent[i] = in_region[i] * patches.area_m2[i];
    emitted += unsent[i];
  }
  auto batch = std::make_unique<RayBatch>();
  double left = emitted, rays_left = kImportanceRays;
  for (uint32_t step = 0; step < kImportanceSteps && left > kUnsentImportance * emitted; ++step) {
    // Half of the rays that are left: the first bounces matter most.
    const double per_ray = left / (0.5 * rays_left);
    rays_left *= 0.5;
    std::vector<double> arrived(patches.size());
    double carried = 0.5;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      carried += unsent[i] / per_ray;
      const auto rays = static_cast<uint32_t>(carried);
      carried -= rays;
      const double share = std::max(unsent[i], per_ray) / std::max(1u, rays);
      const RandomStream stream{0, static_cast<uint32_t>(i), step, 0};
      for (uint32_t begin = 0; begin < rays; begin += RayBatch::kCapacity) {
        batch->size = 0;
        AppendCosineRays(emitters.Frame(i), stream, begin,
                         std::min<uint32_t>(rays, begin + RayBatch::kCapacity), *batch);
        scene.Trace(*batch);
        for (int k = 0; k < batch->size; ++k) {
          if (batch->hit[k] >= 0) arrived[batch->hit[k]] += share;
        }
      }
    }
    left = 0;
    for (PatchIndex i = 0; i < patches.size(); ++i) {
      unsent[i] = Mean(patches.reflectance[i]) * arrived[i];
      importance[i] += unsent[i] / patches.area_m2[i];
      left += unsent[i];
    }
  }
  return importance;
}

absl::StatusOr<std::vector<double>> HitWorth(const PatchSet& patches, const RayScene& scene,
                                             const Emitters& emitters,
                                             const ShootOptions& options) {
  if (options.method != Method::kImportance) return ErrorWorth(patches, options.pyramids.metric);
  absl::StatusOr<std::vector<uint8_t>> region = RegionPatches(patches, options.region);
  if (!region.ok()) return region.status();
  std::vector<double> worth = RegionImportance(patches, scene, emitters, *region);
  for (double& w : worth) w *= w;
  return worth;
}

absl::StatusOr<std::vector<double>> AllocationWeights(const PatchSet& patches,
                                                      const ShootOptions& options) {
  const bool by_flux = options.allocation == Allocation::kFlux;
  if (by_flux && options.method != Method::kImportance) return std::vector<double>{};
  absl::StatusOr<std::unique_ptr<RayScene>> scene = RayScene::Create(patches);
  if (!scene.ok()) return scene.status();
  const Emitters emitters(patches, **scene);
  absl::StatusOr<std::vector<double>> worth = HitWorth(patches, **scene, emitters, options);
  if (!worth.ok()) return worth.status();
  // Coarser than densities: a sum over all directions needs less.
  constexpr int kSide = 4;
  constexpr double kOpening = 0.5;
  const TargetTree targets(patches, *worth);
  const ConcentricGrid cells(kSide);
  const std::vector<double> fractions(cells.size(), cells.flux_fraction(0));
  std::vector<double> weights(patches.size());
  double emitted = 0, weighted = 0, sum = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const std::vector<double> parts =
        LeastVariance(fractions, targets.Moments(PatchFrame(patches, i), cells, kOpening));
    weights[i] = std::accumulate(parts.begin(), parts.end(), 0.0);
    sum += weights[i];
  }
  const double least = kLeastWeight * sum / std::max<PatchIndex>(1, patches.size());
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    weights[i] = least > 0 ? weights[i] + least : 1;
    const double flux = Mean(patches.exitance_lm_per_m2[i]) * patches.area_m2[i];
    emitted += flux;
    weighted += flux * weights[i];
  }
  const double scale = weighted > 0 ? emitted / weighted : 1;
  for (double& weight : weights) weight *= scale;
  return weights;
}

}  // namespace lambert

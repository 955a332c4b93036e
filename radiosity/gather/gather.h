// Final gather: what arrives at points, from a solution. Lamps are sampled explicitly, so shadows
// are as sharp as the geometry and not as coarse as the patches.
//
//   E(x) = E_lamps(x) + E_reflected(x)
//   E_lamps: from emissive patches, exitance / pi times cosine and solid angle, where nothing
//   stands between, by rays towards them (lamp_tree.h); and from other lights, one ray each.
//   E_reflected: the mean of what the patches that cosine rays meet reflect, radiosity - exitance.
//
// Unbiased, given the solution. Backs of one-sided patches are black, as in shooting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/core/rgb.h"
#include "radiosity/gather/gather_points.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// Immutable; any number of threads at once.
class Gatherer {
 public:
  // `radiosity_lm_per_m2`: all that leaves each patch, from the solution. Fails as
  // RayScene::Create. Requires: one value a patch; options in range.
  static absl::StatusOr<std::shared_ptr<const Gatherer>> Create(
      std::shared_ptr<const PatchSet> patches, const std::vector<Rgb>& radiosity_lm_per_m2,
      const GatherOptions& options);
  ~Gatherer();

  // Of points [begin, end). The numbers of a ray are those of (seed, first_name + point, ray): a
  // point's values depend on nothing else. Positions and normals that are not finite, and normals
  // of no length, gather nothing. Requires: begin <= end <= points.size().
  Gathered Run(const GatherPoints& points, size_t begin, size_t end, uint32_t first_name = 0) const;

 private:
  struct Impl;
  explicit Gatherer(std::unique_ptr<const Impl> impl);
  const std::unique_ptr<const Impl> impl_;
};

// A GatherFunction that runs in the calling thread. Fails as Gatherer::Create does.
absl::StatusOr<GatherFunction> GatherHere(std::shared_ptr<const PatchSet> patches,
                                          const std::vector<Rgb>& radiosity_lm_per_m2,
                                          const GatherOptions& options);

}  // namespace lambert

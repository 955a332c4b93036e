// Final gather: what arrives at points, from a solution. Lamps are sampled explicitly, so shadows
// are as sharp as the geometry and not as coarse as the patches.
//
//   E(x) = E_lamps(x) + E_reflected(x)
//   E_lamps: from emissive patches, exitance / pi times cosine and solid angle, where nothing
//   stands between, by rays towards them (lamp_tree.h); and from point lights, one ray each.
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
#include "radiosity/core/vec3.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

// Where light is looked for, and on which side. Points on a patch are lifted off it; one within a
// solid sees its inside, which is black.
struct GatherPoints {
  std::vector<Vec3> position_m;  // relative to PatchSet::origin
  std::vector<Vec3> normal;      // unit; as many

  size_t size() const { return position_m.size(); }
  void Add(Vec3 position, Vec3 unit_normal) {
    position_m.push_back(position);
    normal.push_back(unit_normal);
  }
};

// What arrives there, one value a point.
struct Gathered {
  std::vector<Rgb> irradiance_lx;
  std::vector<Rgb> std_error_lx;  // from kGatherReplicates independent parts; of the rays alone

  bool operator==(const Gathered&) const = default;
};

// Gathers somewhere: in this thread, or on a server's workers.
using GatherFunction = std::function<absl::StatusOr<Gathered>(const GatherPoints&)>;

inline constexpr int kGatherReplicates = 4;
inline constexpr int kMaxGatherRays = 1 << 16;

struct GatherOptions {
  // Rays over the hemisphere of each point, and as many to lamps; rounded up to a multiple of
  // kGatherReplicates. 1 .. kMaxGatherRays.
  int rays_per_point = 64;
  uint64_t seed = 1;
};

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

// Where the flux of a ray comes to rest: at the patch that it hits, or at an element around it.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/patch/surface_tree.h"
#include "radiosity/shoot/options.h"
#include "radiosity/shoot/unit.h"
#include "radiosity/trace/ray_batch.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// The oracle of hierarchical radiosity (HSA91, BNN98) for one ray. Around the source of the ray,
// sigma rays start from each square metre. An element e of area A receives from a part of the
// source as large as itself, or from all of the source's surface A_s where that is smaller, about
//   n_e = sigma min(A, A_s) A cos_i cos_e / (pi d^2)
// rays. A ray comes to rest at the largest element around the patch that it hits with
// n_e <= hier_flux and radius <= hier_size d; where none is, at the patch. So strong light is
// resolved down to the patches; light that is weak where it arrives is spread until it is not. With
// more rays, elements shrink to patches.
//
// Immutable; any number of threads at once.
class Refinement {
 public:
  // `scene` and `tree` are of `patches`; all are only read here.
  Refinement(const PatchSet& patches, const RayScene& scene, const SurfaceTree& tree,
             const PyramidOptions& options);

  // Announces that a patch will be asked for.
  void Prefetch(PatchIndex patch) const { __builtin_prefetch(&leaves_[patch]); }
  // A place of SurfaceTree for ray `slot` of the batch, which hit a patch. `unit_rays_per_m2`: of
  // the unit (unit.h); more where the visit alone shoots more. Requires: the ray is of `visit`.
  PatchIndex Place(const Visit& visit, double unit_rays_per_m2, const RayBatch& batch,
                   int slot) const;

 private:
  struct Leaf {
    float centroid[3], normal[3];  // in trace coordinates
    float area = 0, surface = 0;   // of the patch and of the whole of its flat surface
    int32_t parent = -1;
  };
  struct Node {
    float area = 0, radius = 0;
    int32_t parent = -1;
  };
  // Over what the rays of a light spread where they are densest: a solid angle [sr], or an area.
  struct Beam {
    bool is_parallel = false;
    float extent = 0;
  };
  // Area of the largest element that light of this source may rest at.
  float MostArea(const Visit& visit, float rays_per_area, const float direction[3], float distance,
                 float cosine) const;

  const float flux_, size_;
  const double per_area_;  // square metres in trace coordinates, inverse
  std::vector<Leaf> leaves_;
  std::vector<Node> nodes_;
  std::vector<Beam> beams_;  // of each light
};

}  // namespace lambert

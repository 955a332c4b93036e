// Where rays start and which way they go: positions on patches and point lights, directions by the
// cosine law, over the sphere, or inside a pyramid.
#pragma once

#include <vector>

#include "radiosity/core/lanes.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/pyramid/spherical_triangle.h"
#include "radiosity/shoot/ray_numbers.h"
#include "radiosity/trace/ray_batch.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// A patch in trace coordinates and its local frame (z = normal), ready for a visit.
struct EmitterFrame {
  float corner[3], edge1[3], edge2[3];
  float x[3], y[3], z[3];
};

// Eight of them, lane by lane.
struct EmitterFrame8 {
  Float8 corner[3], edge1[3], edge2[3];
  Float8 x[3], y[3], z[3];
};

// The frames of all patches, compact; point lights have a position only. Immutable.
class Emitters {
 public:
  Emitters(const PatchSet& patches, const RayScene& scene);

  PatchIndex patch_count() const { return static_cast<PatchIndex>(triangles_.size()); }
  PatchIndex size() const { return patch_count() + static_cast<PatchIndex>(point_lights_.size()); }
  bool IsPointLight(PatchIndex emitter) const { return emitter >= patch_count(); }
  // Requires: emitter < patch_count().
  EmitterFrame Frame(PatchIndex emitter) const;
  // Frames of eight patches, each equal to Frame of its emitter.
  EmitterFrame8 Frames(const uint32_t emitters[8]) const;
  // Requires: IsPointLight(emitter).
  const float* Position(PatchIndex emitter) const {
    return point_lights_[emitter - patch_count()].data();
  }

 private:
  std::vector<std::array<float, 9>> triangles_;  // corner 0, edge to 1, edge to 2
  std::vector<std::array<float, 3>> point_lights_;
};

// Each appends rays [begin, end) of a visit to the batch. Requires: room for them.

// Uniform on the patch, cosine law (figure 2 of JPS00; the direction by SC97's concentric map).
void AppendCosineRays(const EmitterFrame& frame, const RayNumbers& numbers, uint32_t begin,
                      uint32_t end, RayBatch& batch);
// The same for `count` <= 8 rays of any patches, each with its frame and its numbers.
void AppendCosineRays(const EmitterFrame8& frames, const RandomNumbers8& numbers, int count,
                      RayBatch& batch);
// Uniform over the sphere.
void AppendSphereRays(const float position[3], const RayNumbers& numbers, uint32_t begin,
                      uint32_t end, RayBatch& batch);

// Ray begin + k starts uniformly on the patch and leaves through *pyramids[k].
using PyramidOfRay = const SphericalTriangle* const*;
// Uniform in the solid angle of the pyramid (figure 7). Writes cos theta of the ray in each slot of
// the batch to cosine[slot] (RayBatch::kSlots values).
void AppendSolidAngleRays(const EmitterFrame& frame, PyramidOfRay pyramids,
                          const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch,
                          float* cosine);
// The same with density proportional to cos theta inside the pyramid, by rejection.
void AppendProjectedAngleRays(const EmitterFrame& frame, PyramidOfRay pyramids,
                              const RayNumbers& numbers, uint32_t begin, uint32_t end,
                              RayBatch& batch);

// Ray begin + k leaves through cell cells[k] of a ConcentricGrid of `side` by `side` cells, with
// density proportional to cos theta inside it.
void AppendGridRays(const EmitterFrame& frame, int side, const int32_t* cells,
                    const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch);

}  // namespace lambert

// Where the rays of patches start and which way they go: by the cosine law, or inside a pyramid.
#pragma once

#include <vector>

#include "radiosity/core/lanes.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/patch/surface_tree.h"
#include "radiosity/pyramid/spherical_triangle.h"
#include "radiosity/shoot/light_rays.h"
#include "radiosity/shoot/ray_numbers.h"
#include "radiosity/trace/ray_batch.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// A patch in trace coordinates and its local frame (z = normal, y = z x x): one cache line.
struct alignas(64) EmitterFrame {
  float corner[3], edge1[3], edge2[3];
  float x[3], z[3];
};

// Eight of them, lane by lane.
struct EmitterFrame8 {
  Vector<Float8> corner, edge1, edge2;
  Vector<Float8> x, y, z;
};

// The frames of all patches; lights shoot from their own (light_rays.h). Immutable.
class Emitters {
 public:
  // `tree` of the patches, or null: whose frames they are (local_frame.h).
  Emitters(const PatchSet& patches, const RayScene& scene, const SurfaceTree* tree = nullptr);

  PatchIndex patch_count() const { return static_cast<PatchIndex>(frames_.size()); }
  PatchIndex size() const { return patch_count() + static_cast<PatchIndex>(lights_.size()); }
  bool IsLight(PatchIndex emitter) const { return emitter >= patch_count(); }
  // Requires: emitter < patch_count().
  const EmitterFrame& Frame(PatchIndex emitter) const { return frames_[emitter]; }
  void Prefetch(PatchIndex emitter) const { __builtin_prefetch(&frames_[emitter]); }
  EmitterFrame8 Frames(const uint32_t emitters[8]) const;
  // Requires: IsLight(emitter).
  const LightRays& LightOf(PatchIndex emitter) const { return lights_[emitter - patch_count()]; }

 private:
  std::vector<EmitterFrame> frames_;
  std::vector<LightRays> lights_;
};

// Each appends rays [begin, end) of a visit to the batch. Requires: room for them.

// Uniform on the patch, cosine law (figure 2 of JPS00; the direction by SC97's concentric map).
void AppendCosineRays(const EmitterFrame& frame, const RayNumbers& numbers, uint32_t begin,
                      uint32_t end, RayBatch& batch);

// Each appends `count` <= 8 rays of any patches, lane by lane, and may write to eight slots: the
// frames of their patches, their numbers, and what they leave through. They start uniformly on the
// patch. Requires: eight lanes that are valid, room for `count` rays.

// By the cosine law.
void AppendCosineRays(const EmitterFrame8& frames, const RandomNumbers8& numbers, int count,
                      RayBatch& batch);
// The same from points of the patches instead, which are given by the weights of their corners 1
// and 2, rounded into the patch: rays that go on from where others have hit. `direction`: the
// numbers of their directions.
void AppendCosineRays(const EmitterFrame8& frames, const float u[8], const float v[8],
                      const float direction[2][8], int count, RayBatch& batch);
// Uniform in the solid angle of a pyramid (figure 7). Writes cos theta of the ray in each slot of
// the batch to cosine[slot] (RayBatch::kSlots values).
void AppendSolidAngleRays(const EmitterFrame8& frames, const SphericalTriangle* const pyramids[8],
                          const RandomNumbers8& numbers, int count, RayBatch& batch, float* cosine);
// With density proportional to cos theta inside a pyramid, by rejection on the disk. `stream`,
// `names`: whose rays they are, for the numbers of further trials.
void AppendProjectedAngleRays(const EmitterFrame8& frames,
                              const SphericalTriangle* const pyramids[8],
                              const RandomNumbers8& numbers, const RandomStream& stream,
                              const RayNames8& names, int count, RayBatch& batch);
// Through a cell of a ConcentricGrid of `side` by `side` cells, with density proportional to cos
// theta inside it.
void AppendGridRays(const EmitterFrame8& frames, int side, const int32_t cells[8],
                    const RandomNumbers8& numbers, int count, RayBatch& batch);

}  // namespace lambert

// The ceiling: Embree alone on rays that lie ready in packets.
#pragma once

#include <memory>
#include <vector>

#include "radiosity/patch/patch_set.h"
#include "radiosity/trace/ray_batch.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// The triangles of a patch set in an Embree scene of the same flags, build quality and instruction
// set as RayScene's, and one more that is not robust.
class BareEmbree {
 public:
  // Takes the rays of `batches` in their order. `scene` is of `patches`.
  BareEmbree(const PatchSet& patches, const RayScene& scene);
  ~BareEmbree();
  BareEmbree(const BareEmbree&) = delete;
  BareEmbree& operator=(const BareEmbree&) = delete;

  // The rays that the next calls trace, in this order.
  void SetRays(const std::vector<RayBatch>& batches);
  // Makes the packets fresh, as tracing writes to them: not part of what is measured.
  void Reset();
  // rtcIntersect16 and rtcIntersect8 on all rays. Requires: Reset since the last call.
  void Intersect16(bool robust);
  void Intersect8(bool robust);
  // Rays that met a triangle in the last call of Intersect16.
  int64_t Hits16() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambert

// PatchSet -> what rays hit. The only room that knows Embree.
//
// Trace coordinates are the patch set's, recentred on its bounding box and scaled by a power of two
// so that the box has a diagonal in [1, 2): distances and offsets mean the same at any scale.
//
// Leaks and self-hits: traversal is robust (watertight along shared edges), rays start
// kOriginOffset above their patch and may hit at any distance > 0.
//
// Backs of one-sided patches are opaque and black: a ray that meets one ends there and counts as
// escaped (docs/decisions/0003). A front within kTieDistance of the back wins, so walls that stand
// back to back, even in one plane, each show their own side.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/core/vec3.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/trace/ray_batch.h"

namespace lambert {

// Height above its patch at which a ray starts: 8 float32 spacings at coordinate 1, so that
// rounding never puts an origin below its own patch. In trace coordinates.
inline constexpr float kOriginOffset = 4.8e-7f;
// How far behind a back a front still counts as lying in its plane. In trace coordinates.
inline constexpr float kTieDistance = 2e-6f;

// The answer to one ray of a picture.
struct PictureHit {
  PatchIndex patch = kNoPatch;  // kNoPatch: nothing
  double u = 0, v = 0;          // barycentric weights of corners 1 and 2
  double distance_m = 0;
};

// The pins of the tracer, part of the unit version: two programs that agree on them get equal hits.
std::string TracerPins();

// Immutable; any number of threads may trace at once. Needs the patch set no more once it is made.
class RayScene {
 public:
  // FAILED_PRECONDITION where the processor lacks AVX2; RESOURCE_EXHAUSTED without enough memory.
  // Requires: patches.size() > 0.
  static absl::StatusOr<std::unique_ptr<RayScene>> Create(const PatchSet& patches);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // Nearest hit of every ray of the batch; depends on each ray alone, not on its neighbours.
  void Trace(RayBatch& batch) const;

  // Whether anything stands on the segments from the batch's origins to origin + direction:
  // kBlocked or kEscaped in `hit`. Fronts and backs block alike. Ends that lie on a patch are
  // lifted off it: the first by kOriginOffset, the second by kTieDistance.
  void Occlude(RayBatch& batch) const;

  // Nearest side of a patch that a ray sees. `origin` in metres relative to the patch set's origin.
  PictureHit Cast(Vec3 origin, Vec3 direction) const;

  // A point of the patch set [m, relative to its origin] in trace coordinates.
  Vec3 ToTrace(Vec3 point) const;
  // Trace coordinates per metre.
  double scale() const;

 private:
  struct Impl;
  explicit RayScene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambert

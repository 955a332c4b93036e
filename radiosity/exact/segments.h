// Segments between two parts that may see each other: sampled, traced, weighted.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "radiosity/core/philox.h"
#include "radiosity/exact/form_factor.h"
#include "radiosity/exact/light_fraction.h"
#include "radiosity/trace/ray_batch.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// What two parts, or a light and a part, exchange, in points: the mean of `weight` over
// uniform points is the whole without occlusion.
class Segments {
 public:
  // Between the parts of two patches: weights sum to the exchange area.
  explicit Segments(const Facing& facing);
  // From a light, which must outlive it: weights sum to the fraction of its flux.
  Segments(const LightFraction& light, const Triangle& to);

  struct Segment {
    Vec3 from, to;
    double weight;
  };
  // The `number`-th of a sequence that fills the four dimensions of both parts evenly, shifted by
  // `shift` in 0..1: each alone is uniform (R4, Rob18; CP76).
  Segment Sample(const std::array<float, 4>& shift, int64_t number) const;

  Vec3 from_normal() const { return facing_.from_normal; }
  Vec3 to_normal() const { return facing_.to_normal; }
  // True where the parts are closer than about their size: weights then have no bound.
  bool near() const;

 private:
  Facing facing_;
  const LightFraction* light_ = nullptr;  // null: from a patch
  double from_area_m2_ = 0, to_area_m2_ = 0;
};

// Collects segments and traces them a batch at a time. One thread.
class SegmentTracer {
 public:
  explicit SegmentTracer(const RayScene& scene)
      : scene_(scene), batch_(std::make_unique<RayBatch>()) {}

  bool full() const { return batch_->size == RayBatch::kCapacity; }
  // Requires: not full. `from_normal` is zero for a light.
  void Add(Vec3 from, Vec3 from_normal, Vec3 to, Vec3 to_normal);
  // Calls use(k, is_visible) for each segment in the order of Add, and forgets them.
  template <typename Use>
  void Land(Use use) {
    scene_.Occlude(*batch_);
    for (int k = 0; k < batch_->size; ++k) use(k, batch_->hit[k] == kEscaped);
    batch_->size = 0;
  }

 private:
  const RayScene& scene_;
  std::unique_ptr<RayBatch> batch_;
};

}  // namespace lambert

// Where the rays of a light start and which way they go. Every ray carries the same flux: more go
// where more is sent, and none where nothing is.
#pragma once

#include <cstdint>

#include "radiosity/core/bounds.h"
#include "radiosity/core/vec3.h"
#include "radiosity/patch/cone.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/shoot/ray_numbers.h"
#include "radiosity/trace/ray_batch.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

// One light. Immutable.
class LightRays {
 public:
  // `box`: around the patches of `scene`.
  LightRays(const Light& light, const Bounds& box, const RayScene& scene);

  // Appends rays [begin, end) of a visit to the batch. Of a point light they go from its place,
  // with density by its intensity; of a distant one they enter the box around the scene through the
  // faces that it sees, evenly spread over the beam, just outside of it. Requires: room for them.
  void Append(const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch) const;

 private:
  struct Ray {
    Vec3 origin, direction;
  };
  // A face of the box that a distant light sees, and the part of the beam that enters by it and by
  // those before it.
  struct Face {
    Vec3 corner, u, v;
    double until = 0;
  };
  void AddFaces(const Bounds& box);
  Ray FromPlace(double u, double v) const;
  Ray ThroughBox(double u, double v) const;

  Light::Kind kind_;
  Vec3 position_;  // in trace coordinates
  Vec3 x_, y_, z_;
  Cone cone_;
  std::vector<Face> faces_;
};

}  // namespace lambert

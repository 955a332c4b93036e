// Where the rays of a light start and which way they go. Every ray carries the same flux: more go
// where more is sent, and none where nothing is.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

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

  // Appends rays [begin, end) of a visit to the batch. From a place they go with density by
  // intensity; of a distant light they enter the box around the scene through the faces that it
  // sees, evenly spread over the beam; of a sky they go with density by luminance, from anywhere on
  // the disk before the sphere around that box. Requires: room for them.
  //
  // A sky of several colours that are not alike everywhere cannot give equal flux in each channel:
  // then `weight` says what the ray of each slot carries of its share, 1 in the mean and at most 3.
  void Append(const RayNumbers& numbers, uint32_t begin, uint32_t end, RayBatch& batch,
              Rgb weight[RayBatch::kSlots]) const;
  bool weighted() const { return table_ != nullptr && table_->grid().channels > 1; }

 private:
  struct Ray {
    Vec3 origin, direction;
    Rgb weight{1, 1, 1};
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
  Ray FromTable(double u, double v) const;
  Ray FromSky(const float xi[4]) const;
  Ray Of(const float xi[4]) const;

  Light::Kind kind_;
  Vec3 position_;  // in trace coordinates
  Vec3 x_, y_, z_;
  Cone cone_;
  std::vector<Face> faces_;
  std::shared_ptr<const SphereTable> table_;
  Vec3 center_;  // of the box
  double radius_ = 0;
};

}  // namespace lambert

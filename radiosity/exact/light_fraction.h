// What a triangle gets of a light's flux where nothing is in between.
#pragma once

#include "radiosity/exact/polygon.h"
#include "radiosity/patch/patch_set.h"

namespace lambert {

class LightFraction {
 public:
  // Of one light of the patches, which must outlive it.
  LightFraction(const PatchSet& patches, int light);

  // The fraction of the light's flux that arrives at the front of a triangle. In closed form for
  // lights that shine all around (solid angle / (4 pi)) and distant ones; else by quadrature, to
  // 1e-6 of the flux.
  double Of(const Triangle& triangle) const;
  // The same per area at a point of a surface [1/m2].
  double Density(const Vec3& point, const Vec3& normal) const;
  // The end of a segment from the point to the light: its place, or outside the scene.
  Vec3 SeenFrom(const Vec3& point) const;
  // The light's place; of a distant one anywhere outside the scene.
  Vec3 place() const;

 private:
  double Quadrature(const Triangle& triangle, const Vec3& normal, double whole, int depth) const;
  double Rule(const Triangle& triangle, const Vec3& normal) const;

  const PatchSet& patches_;
  const int light_;
  double flux_lm_ = 0;    // mean of the channels
  double outside_m_ = 0;  // from any point of the scene
};

}  // namespace lambert

// Where a picture is taken from.
#pragma once

#include <string>
#include <vector>

#include "radiosity/core/bounds.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/trace/ray_scene.h"

namespace lambert {

struct View {
  std::string origin;  // for people: "the scene's camera 'Main'"
  Vec3 eye;            // metres, relative to the patch set's origin
  Vec3 right{1, 0, 0}, up{0, 1, 0}, forward{0, 0, -1};  // orthonormal
  bool perspective = true;
  double half_height = 0.5;  // of the picture: tangent of half the angle; orthographic: metres
  double aspect = 1.5;       // width / height

  // The ray through a point of the picture: x 0..1 from left to right, y 0..1 from top to bottom.
  struct Ray {
    Vec3 origin, direction;  // direction of any length
  };
  Ray RayThrough(double x, double y) const;
};

// As the camera says. An aspect that the file leaves open becomes 3:2, one beyond 1:4 or 4:1 is
// drawn in to that.
View CameraView(const Camera& camera);

// The middle of a view, `factor` times as large. Requires: factor > 0.
View Enlarged(const View& view, double factor);

// From the same place, turned to a box and narrowed until the box fills the picture, but not
// widened beyond `view`. The middle of `view`, three times as large, where the box reaches behind
// the eye.
View CloseUp(const View& view, const Bounds& box);

// The scene's first camera that sees something; else the best of some hundred views, from inside
// and from outside, by the lit area that they see and how well it fills the picture.
// `radiosity_lm_per_m2` is by patch. Requires: `scene` was made of `patches`.
View ChooseView(const PatchSet& patches, const RayScene& scene,
                const std::vector<Rgb>& radiosity_lm_per_m2);

}  // namespace lambert

// Writes a scene of coloured triangles as one GLB file.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "radiosity/core/rgb.h"
#include "radiosity/core/vec3.h"

namespace lambert::examples {

struct GlbMaterial {
  std::string name;
  Rgb reflectance;    // 0..1
  Rgb luminance_nit;  // 0: emits nothing
};

// One node with one mesh of one primitive.
struct GlbObject {
  std::string name;
  int material = 0;
  std::vector<std::array<Vec3, 3>> triangles;  // metres, world, counter-clockwise from the front
};

struct GlbCamera {
  std::string name;
  Vec3 eye, target;  // metres; +y is up
  double yfov_rad = 0.8;
  double aspect = 1.5;
};

struct GlbScene {
  std::string name, copyright;
  std::vector<GlbMaterial> materials;
  std::vector<GlbObject> objects;  // those without triangles are left out
  GlbCamera camera;
};

// The bytes of the file. Corners that agree in float are shared; there are no normals, so viewers
// shade flat. Equal scenes give equal bytes.
std::string EncodeGlb(const GlbScene& scene);

}  // namespace lambert::examples

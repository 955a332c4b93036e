// Scenes made by program, so that tests need no files.
#pragma once

#include <string>
#include <vector>

#include "radiosity/patch/build_patches.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/scene/scene.h"

namespace lambert {

// What a quadrilateral or box of a test scene is made of.
struct Paint {
  Rgb reflectance;
  Rgb exitance_lm_per_m2;  // emitted
  bool two_sided = false;
};

// Builds a scene out of quadrilaterals and boxes; one node, mesh and material for each call.
class SceneMaker {
 public:
  // The parallelogram origin, origin + u, origin + u + v, origin + v, cut into n x n squares of two
  // triangles each; its front is the side that Cross(u, v) points to.
  SceneMaker& Quad(Vec3 origin, Vec3 u, Vec3 v, const Paint& paint, int n = 1,
                   const std::string& name = "quad");
  // A box from `low` to `high` that faces inward (a room) or outward (furniture), n x n squares a
  // face, in the order -x, +x, -y, +y, -z, +z; paints: one for all faces, or six.
  SceneMaker& Box(Vec3 low, Vec3 high, bool inward, const std::vector<Paint>& paints, int n = 1,
                  const std::string& name = "box");
  SceneMaker& Light(Vec3 position, Rgb intensity_cd);
  SceneMaker& LookFrom(Vec3 eye, Vec3 target, double yfov_rad = 0.8);
  Scene Make() const { return scene_; }

 private:
  Scene scene_;
};

// BuildPatches without options. Requires: a scene that it accepts.
PatchSet PatchesOf(const Scene& scene);

// The cube 0..edge_m, facing inward; per_face: exitance of -x, +x, -y, +y, -z, +z.
Scene MakeBox(double edge_m, Rgb reflectance, const std::vector<Rgb>& per_face_lm_per_m2,
              int n = 1);
// The unit cube facing inward where every face reflects and emits alike: B = E / (1 - rho).
Scene MakeFurnace(double reflectance, double exitance_lm_per_m2 = 1, int n = 1);
// The same where the vertices inside the faces are moved about by up to .2 / n: uneven triangles.
Scene MakeJitteredFurnace(double reflectance, double exitance_lm_per_m2, int n);
// A room of 1 m height, L-shaped: three unit squares, whose walls hide each other round the corner.
// Walls, floor and ceiling of 1 m2 are n x n squares; all reflect and emit alike.
Scene MakeLShapedFurnace(double reflectance, double exitance_lm_per_m2, int n);
// Two unit squares of two triangles with the same diagonal. a lies at y = 0, faces up and emits
// 1 lm/m2; b faces it at y = 1, or stands upright on the shared edge z = 0.
Scene MakeParallelSquares(double reflectance_a, double reflectance_b);
Scene MakePerpendicularSquares(double reflectance_a, double reflectance_b);
// A Cornell-like box of 2 m, open in front: lamp, red and green walls, two turned blocks; 16 faces
// of n x n squares, 32 n^2 patches. A camera looks in.
Scene MakeCornell(int n = 1);
// A closed 6 x 3 x 8 m office: desks and shelves of boxes, three lamps. 222 n^2 patches.
Scene MakeOffice(int n = 4);
// A sphere of radius 1 m about the origin that faces inward; 20 * 4^splits triangles.
Scene MakeIcosphere(int splits, const Paint& paint);

// `scene` as a GLB file: meshes, materials without textures, node transforms, cameras, point
// lights.
std::string ToGlb(const Scene& scene);

}  // namespace lambert

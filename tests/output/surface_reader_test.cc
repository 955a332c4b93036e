#include "radiosity/output/surface_reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "radiosity/output/picture.h"
#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// A wall of 2 m at z = 0, of two triangles, before a camera that sees all of it; a plain one 1 m
// behind. Its texture is black on the left, white on the right, and see-through at the lower left.
Scene TwoWalls(double alpha_cutoff) {
  Scene scene = SceneMaker()
                    .Quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {{0.5, 0.5, 0.5}, {}})
                    .Quad({-2, -2, -1}, {4, 0, 0}, {0, 4, 0}, {{0.8, 0.8, 0.8}, {}})
                    .LookFrom({0, 0, 1}, {0, 0, 0}, std::acos(-1.0) / 2)
                    .Make();
  Texture texture;
  texture.width = texture.height = 2;
  texture.rgba = {0, 0, 0, 255, 255, 255, 255, 255, 0, 0, 0, 9, 255, 255, 255, 255};
  scene.textures = {texture};
  scene.materials[0].reflectance_texture.texture = 0;
  scene.materials[0].alpha_cutoff = alpha_cutoff;
  Primitive& wall = scene.meshes[0].primitives[0];
  for (const auto& p : wall.positions) wall.uv[0].push_back({(p[0] + 1) / 2, (1 - p[1]) / 2});
  return scene;
}

// Of the point (x, y) of the plane z = 0.
std::optional<TexelSurface> At(const SurfaceReader& reader, const PatchSet& patches, double x,
                               double y) {
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const Vec3 weights = WeightsAt(patches.corners[i], Vec3{x, y, 0} - patches.origin);
    const bool inside = std::min({weights.x, weights.y, weights.z}) >= 0;
    if (patches.source[i].node == 0 && inside) return reader.At(i, weights);
  }
  ADD_FAILURE() << "no patch is there";
  return std::nullopt;
}

TEST(SurfaceReader, ReadsTheTextureWhereThePatchHasItsMean) {
  Scene scene = TwoWalls(0);
  scene.materials[0].luminance = {3, 3, 3};
  scene.materials[0].luminance_texture.texture = 0;
  const PatchSet patches = PatchesOf(scene);
  const SurfaceReader reader(patches, &scene), means(patches, nullptr);
  EXPECT_EQ(At(reader, patches, -0.5, 0.4)->reflectance, (Rgb{0, 0, 0}));
  EXPECT_EQ(At(reader, patches, 0.5, 0.4)->reflectance, (Rgb{0.5, 0.5, 0.5}));
  EXPECT_NEAR(At(reader, patches, 0.5, 0.4)->exitance_lm_per_m2.g, 3 * std::numbers::pi, 1e-12);
  const double mean = At(means, patches, 0.5, 0.4)->reflectance.g;
  EXPECT_GT(mean, 0.1);
  EXPECT_LT(mean, 0.4);
}

TEST(SurfaceReader, VertexColorsAreLinearBetweenCorners) {
  Scene scene = SceneMaker().Quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {{0.5, 0.5, 0.5}, {}}).Make();
  Primitive& wall = scene.meshes[0].primitives[0];
  for (const auto& p : wall.positions) wall.colors.push_back({(p[0] + 1) / 2, 1, 1, 1});
  const PatchSet patches = PatchesOf(scene);
  const SurfaceReader reader(patches, &scene);
  EXPECT_NEAR(At(reader, patches, 0.5, 0.4)->reflectance.r, 0.5 * 0.75, 1e-6);
}

TEST(DrawPicture, WhatAMaskCutsAwayIsSeenThrough) {
  const Scene scene = TwoWalls(0.5);
  const PatchSet patches = PatchesOf(scene);
  const auto rays = RayScene::Create(patches);
  ASSERT_TRUE(rays.ok());
  const Solution solution = LitBy(patches, [](Vec3) { return Rgb{8, 8, 8}; });
  const SurfaceReader surfaces(patches, &scene);
  const Picture picture = DrawPicture(CameraView(patches.cameras[0]), patches, **rays, solution,
                                      surfaces, FlatIrradiance(solution.irradiance_lx), 60);
  const auto at = [&](int x, int y) {
    return picture.radiosity_lm_per_m2[size_t{1} * y * picture.width + x].g;
  };
  EXPECT_NEAR(at(20, 10), 0, 1e-6);        // black
  EXPECT_NEAR(at(40, 10), 8 * 0.5, 1e-6);  // white
  EXPECT_NEAR(at(20, 30), 8 * 0.8, 1e-6);  // what is behind
}

}  // namespace
}  // namespace lambert

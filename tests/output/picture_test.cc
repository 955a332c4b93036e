#include "radiosity/output/picture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "radiosity/output/smooth.h"
#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

Picture Draw(const PatchSet& patches, const std::function<Rgb(Vec3)>& irradiance_lx,
             int longer_side = 60) {
  const auto scene = RayScene::Create(patches);
  EXPECT_TRUE(scene.ok());
  const Solution solution = LitBy(patches, irradiance_lx);
  return DrawPicture(
      CameraView(patches.cameras[0]), patches, **scene, solution, {patches, nullptr},
      SmoothIrradiance(patches, FindCornerFans(patches, **scene), solution.irradiance_lx),
      longer_side);
}

// A square of 2 m that a camera 1 m away sees to its edges (full angle 90 degrees).
PatchSet Wall(const Paint& paint, double eye_z = 1) {
  return PatchesOf(SceneMaker()
                       .Quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, paint, 4)
                       .LookFrom({0, 0, eye_z}, {0, 0, 0}, std::acos(-1.0) / 2)
                       .Make());
}

TEST(DrawPicture, HasTheAspectOfItsView) {
  const Picture wide = Draw(Wall({{0.5, 0.5, 0.5}, {}}), [](Vec3) { return Rgb{1, 1, 1}; });
  EXPECT_EQ(wide.width, 60);
  EXPECT_EQ(wide.height, 40);
  EXPECT_EQ(wide.patch.size(), 2400u);
}

TEST(DrawPicture, RadiosityIsExitancePlusReflectedIrradiance) {
  const Picture picture = Draw(Wall({{0.5, 0.25, 0}, {1, 2, 3}}), [](Vec3) {
    return Rgb{8, 8, 8};
  });
  const size_t middle = 20 * 60 + 30;
  EXPECT_NEAR(picture.radiosity_lm_per_m2[middle].r, 5, 1e-6);
  EXPECT_NEAR(picture.radiosity_lm_per_m2[middle].g, 4, 1e-6);
  EXPECT_NEAR(picture.radiosity_lm_per_m2[middle].b, 3, 1e-6);
  EXPECT_NEAR(picture.irradiance_lx[middle].g, 8, 1e-6);
  EXPECT_NEAR(picture.std_error_lm_per_m2[middle].g, 0.04, 1e-6);
}

TEST(DrawPicture, AnExposureThatIsGivenIsKept) {
  const PatchSet patches = Wall({{0.5, 0.5, 0.5}, {}});
  const auto scene = RayScene::Create(patches);
  ASSERT_TRUE(scene.ok());
  const Solution solution = LitBy(patches, [](Vec3) { return Rgb{8, 8, 8}; });
  const Picture picture =
      DrawPicture(CameraView(patches.cameras[0]), patches, **scene, solution, {patches, nullptr},
                  FlatIrradiance(solution.irradiance_lx), 60, {ToneMap::kLinear, 0.125});
  EXPECT_EQ(picture.exposure.per_lm_per_m2, 0.125);
  EXPECT_EQ(picture.exposure.tone_map, ToneMap::kLinear);
  EXPECT_NEAR(picture.display[20 * 60 + 30].g, 4 * 0.125, 1e-6);
}

TEST(DrawPicture, FlatIrradianceShowsEveryPatchAsItWasSolved) {
  const PatchSet patches = Wall({{1, 1, 1}, {}});
  const auto scene = RayScene::Create(patches);
  ASSERT_TRUE(scene.ok());
  const Solution solution = LitBy(patches, [](Vec3 p) { return Rgb{9 + p.x, 9 + p.y, 9}; });
  const Picture picture =
      DrawPicture(CameraView(patches.cameras[0]), patches, **scene, solution, {patches, nullptr},
                  FlatIrradiance(solution.irradiance_lx), 60);
  for (size_t pixel = 0; pixel < picture.patch.size(); ++pixel) {
    if (picture.patch[pixel] == kNoPatch) continue;
    EXPECT_NEAR(picture.irradiance_lx[pixel].g, solution.irradiance_lx[picture.patch[pixel]].g,
                1e-5);
  }
}

TEST(DrawPicture, ALinearFieldIsDrawnWithoutFacets) {
  const Picture picture = Draw(Wall({{1, 1, 1}, {}}), [](Vec3 p) {
    const double light = 10 + 3 * p.y;
    return Rgb{light, light, light};
  });
  // At 1 m the 40 rows show 2 m; row y has its middle at 1 - (y + .5) / 20 m.
  for (int y = 10; y < 30; ++y) {
    const double height_m = 1 - (y + 0.5) / 20;
    EXPECT_NEAR(picture.irradiance_lx[y * 60 + 30].g, 10 + 3 * height_m, 1e-4);
  }
}

TEST(DrawPicture, NothingIsZeroAndNoPatch) {
  // The square covers the 40 columns in the middle of 60.
  const Picture picture = Draw(Wall({{0.5, 0.5, 0.5}, {}}), [](Vec3) { return Rgb{1, 1, 1}; });
  EXPECT_EQ(picture.patch[0], kNoPatch);
  EXPECT_EQ(picture.radiosity_lm_per_m2[0], Rgb{});
  EXPECT_GT(picture.display[0].b, 0);
  EXPECT_NE(picture.patch[20 * 60 + 30], kNoPatch);
}

TEST(DrawPicture, EdgesAreDrawnWithPartOfAPixel) {
  // From 1.013 m the edge of the square falls within a pixel.
  const Picture picture = Draw(Wall({{0.5, 0.5, 0.5}, {}}, 1.013), [](Vec3) {
    return Rgb{2, 2, 2};
  });
  int partly = 0;
  for (const Rgb& radiosity : picture.radiosity_lm_per_m2) {
    partly += radiosity.g > 0.05 && radiosity.g < 0.95;
  }
  EXPECT_GT(partly, 30);
}

TEST(DrawPicture, BacksOfOneSidedPatchesAreSeenThrough) {
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Quad({-1, -1, 0}, {0, 2, 0}, {2, 0, 0}, {{1, 1, 1}, {}})
                                         .Quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, {{1, 1, 1}, {}})
                                         .LookFrom({0, 0, 1}, {0, 0, 0})
                                         .Make());
  const Picture picture = Draw(patches, [](Vec3) { return Rgb{1, 1, 1}; });
  const PatchIndex seen = picture.patch[20 * 60 + 30];
  ASSERT_NE(seen, kNoPatch);
  EXPECT_EQ(patches.source[seen].node, 1);
}

}  // namespace
}  // namespace lambert

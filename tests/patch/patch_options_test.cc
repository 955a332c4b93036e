// What options make of a scene: --scene-unit and --blend.
#include <gtest/gtest.h>

#include <numbers>

#include "radiosity/core/error.h"
#include "radiosity/patch/build_patches.h"
#include "radiosity/patch/place.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

TEST(SceneUnit, ScalesPlacesOfAllAndNoLight) {
  const Scene scene = SceneMaker()
                          .Quad({100, 0, 0}, {0, 0, 100}, {100, 0, 0}, {{0.5, 0.5, 0.5}, {2, 2, 2}})
                          .Light({150, 300, 50}, {7, 7, 7})
                          .LookFrom({150, 500, 50}, {150, 0, 51})
                          .Make();
  PatchOptions options;
  options.max_edge_m = 0.75;
  EXPECT_GT(BuildPatches(scene, options)->size(), 2000);
  options.metres_per_unit = 0.01;
  const PatchSet patches = *BuildPatches(scene, options);
  EXPECT_EQ(patches.size(), 8) << "--max-edge counts metres";
  double area_m2 = 0;
  for (double a : patches.area_m2) area_m2 += a;
  EXPECT_NEAR(area_m2, 1, 1e-12);
  EXPECT_NEAR(Length(patches.origin - Vec3{1.5, 0, 0.5}), 0, 1e-12);
  EXPECT_NEAR(Length(patches.lights[0].position - Vec3{0, 3, 0}), 0, 1e-12);
  EXPECT_EQ(patches.lights[0].strength, (Rgb{7, 7, 7}));
  EXPECT_NEAR(Length(patches.cameras[0].world.translation - Vec3{0, 5, 0}), 0, 1e-12);
  EXPECT_NEAR(patches.cameras[0].half_height_m, 0.01, 1e-15);
  EXPECT_NEAR(EmittedFlux(patches).r, 2 + 28 * std::numbers::pi, 1e-9);
}

TEST(SceneUnit, ScalesWhatFilesShowAsPatches) {
  Scene scene =
      SceneMaker().Quad({100, 0, 0}, {0, 0, 100}, {100, 0, 0}, {{0.5, 0.5, 0.5}, {2, 2, 2}}).Make();
  PatchOptions options;
  options.metres_per_unit = 0.01;
  const PatchSet patches = *BuildPatches(scene, options);
  ScaleInstances(options.metres_per_unit, scene);
  Bounds shown;
  const absl::Status seen = ForEachTriangle(scene, {}, [&](const PlacedTriangle& triangle) {
    for (const Vec3& corner : triangle.corners) shown.Add(corner - patches.origin);
    return absl::OkStatus();
  });
  EXPECT_TRUE(seen.ok());
  EXPECT_NEAR(Length(shown.low - BoundsOf(patches).low), 0, 1e-9);
  EXPECT_NEAR(Length(shown.high - BoundsOf(patches).high), 0, 1e-9);
}

TEST(Blend, IsOpaqueOrLeftOutAndNamed) {
  Scene scene = SceneMaker()
                    .Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {1, 1, 1}})
                    .Quad({0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}})
                    .Make();
  scene.materials[1].blend = true;
  const auto named = [](const PatchSet& patches, const std::string& text) {
    for (const Warning& warning : patches.warnings) {
      if (warning.reason == "ALPHA_BLEND") {
        return warning.message.find(text) != std::string::npos;
      }
    }
    return false;
  };
  const PatchSet opaque = *BuildPatches(scene, {});
  EXPECT_EQ(opaque.size(), 4);
  EXPECT_TRUE(named(opaque, "1 material(s) taken as opaque"));
  PatchOptions omit;
  omit.blend = Blend::kOmit;
  const PatchSet omitted = *BuildPatches(scene, omit);
  EXPECT_EQ(omitted.size(), 2);
  EXPECT_TRUE(named(omitted, "1 material(s) left out"));
  scene.materials[0].blend = true;
  const absl::Status nothing = BuildPatches(scene, omit).status();
  EXPECT_EQ(ReasonOf(nothing), "NO_TRIANGLES");
  EXPECT_NE(nothing.message().find("--blend opaque"), std::string::npos) << nothing;
}

}  // namespace
}  // namespace lambert

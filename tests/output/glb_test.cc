#include "radiosity/output/glb.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "radiosity/output/output_file.h"
#include "radiosity/output/smooth.h"
#include "radiosity/scene/load_gltf.h"
#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

std::string GlbOf(const PatchSet& patches, const std::function<Rgb(Vec3)>& irradiance_lx) {
  const auto scene = RayScene::Create(patches);
  EXPECT_TRUE(scene.ok());
  const Solution solution = LitBy(patches, irradiance_lx);
  const View view = ChooseView(patches, **scene, solution.radiosity_lm_per_m2);
  const absl::StatusOr<std::string> glb = EncodeGlb(
      patches, SmoothIrradiance(patches, FindCornerFans(patches, **scene), solution.irradiance_lx),
      ChooseExposure(solution.radiosity_lm_per_m2, patches.exitance_lm_per_m2), view);
  EXPECT_TRUE(glb.ok()) << glb.status();
  return *glb;
}

Scene Reloaded(const std::string& glb) {
  SceneBundle bundle;
  bundle.main_name = "out.glb";
  bundle.main_bytes = glb;
  absl::StatusOr<Scene> scene = LoadGltf(bundle);
  EXPECT_TRUE(scene.ok()) << scene.status();
  return *std::move(scene);
}

Rgb SomeLight(Vec3 p) { return {1 + p.x * p.x, 2 + p.y, 3}; }

TEST(EncodeGlb, ReadsBackToTheSameTrianglesNodeByNode) {
  const PatchSet patches = PatchesOf(MakeCornell(2));
  const Scene scene = Reloaded(GlbOf(patches, SomeLight));
  size_t triangles = 0;
  double area = 0;
  for (const Instance& instance : scene.instances) {
    EXPECT_EQ(scene.node_names[instance.node], scene.meshes[instance.mesh].name);
    for (const Primitive& primitive : scene.meshes[instance.mesh].primitives) {
      triangles += primitive.triangles.size();
    }
  }
  EXPECT_EQ(triangles, static_cast<size_t>(patches.size()));
  EXPECT_EQ(scene.cameras.size(), 1u);
  for (double patch_area : patches.area_m2) area += patch_area;
  double area_back = 0;
  for (double patch_area : PatchesOf(scene).area_m2) area_back += patch_area;
  EXPECT_NEAR(area_back, area, 1e-5 * area);
}

TEST(EncodeGlb, EqualVerticesAreStoredOnce) {
  const PatchSet patches =
      PatchesOf(SceneMaker().Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.5, 0.5, 0.5}, {}}, 8).Make());
  const Scene scene = Reloaded(GlbOf(patches, [](Vec3) { return Rgb{1, 1, 1}; }));
  EXPECT_EQ(scene.meshes[0].primitives[0].positions.size(), 81u);
}

TEST(EncodeGlb, StandsWhereTheSceneStood) {
  PatchSet patches = PatchesOf(MakeCornell());
  patches.origin = {1e6, 2, 3};
  const Scene scene = Reloaded(GlbOf(patches, SomeLight));
  EXPECT_EQ(scene.instances[0].world.translation, patches.origin);
}

TEST(EncodeGlb, TheKhronosValidatorFindsNoError) {
  if (!std::filesystem::exists(LAMBERT_TEST_TOOLS "/node_modules/gltf-validator")) {
    GTEST_SKIP() << "gltf-validator is not installed";
  }
  std::vector<std::string> files;
  const std::string folder = TestFolder();
  auto add = [&](const std::string& name, const PatchSet& patches,
                 const std::function<Rgb(Vec3)>& light) {
    files.push_back(folder + "/" + name + ".glb");
    ASSERT_TRUE(WriteOutputFile(files.back(), GlbOf(patches, light)).ok());
  };
  PatchSet cornell = PatchesOf(MakeCornell(2));
  add("cornell", cornell, SomeLight);
  add("dark", cornell, [](Vec3) { return Rgb{}; });
  add("bright", cornell, [](Vec3) { return Rgb{1e30, 1e300, 1e38}; });
  add("dim", cornell, [](Vec3) { return Rgb{1e-30, 1e-300, 1e-310}; });
  for (auto& corners : cornell.corners) {
    for (Vec3& corner : corners) corner = corner * 1e-18;
  }
  cornell.node_names[0] = "not \xff UTF-8";
  add("tiny", cornell, SomeLight);
  std::string command = "node " LAMBERT_TEST_TOOLS "/validate_glb.cjs";
  for (const std::string& file : files) command += " '" + file + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace lambert

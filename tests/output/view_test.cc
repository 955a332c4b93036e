#include "radiosity/output/view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/core/bounds.h"
#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

constexpr Paint kGray{{0.5, 0.5, 0.5}, {}};

View ViewOf(const PatchSet& patches) {
  const auto scene = RayScene::Create(patches);
  EXPECT_TRUE(scene.ok());
  const Solution solution = LitBy(patches, [](Vec3) { return Rgb{1, 1, 1}; });
  return ChooseView(patches, **scene, solution.radiosity_lm_per_m2);
}

bool Inside(const Bounds& box, Vec3 p) {
  return p.x > box.low.x && p.y > box.low.y && p.z > box.low.z && p.x < box.high.x &&
         p.y < box.high.y && p.z < box.high.z;
}

TEST(View, RaysOfAPerspectiveMeetTheEdgesOfItsAngle) {
  View view;
  view.half_height = 0.5;
  view.aspect = 2;
  EXPECT_EQ(view.RayThrough(0.5, 0.5).direction, (Vec3{0, 0, -1}));
  EXPECT_EQ(view.RayThrough(0, 0).direction, (Vec3{-1, 0.5, -1}));
  EXPECT_EQ(view.RayThrough(1, 1).direction, (Vec3{1, -0.5, -1}));
}

TEST(View, RaysOfAnOrthographicCameraAreParallel) {
  Camera camera;
  camera.perspective = false;
  camera.half_height_m = 3;
  camera.aspect = 1;
  const View::Ray ray = CameraView(camera).RayThrough(1, 0);
  EXPECT_EQ(ray.origin, (Vec3{3, 3, 0}));
  EXPECT_EQ(ray.direction, (Vec3{0, 0, -1}));
}

TEST(Enlarged, ShowsTheMiddle) {
  View view;
  view.half_height = 0.6;
  const View::Ray near = Enlarged(view, 3).RayThrough(1, 0.5);
  EXPECT_NEAR(near.direction.x, 0.2 * view.aspect, 1e-12);
  EXPECT_EQ(near.direction.z, -1);
}

// Where a point stands in the picture: 0..1 from left to right and from top to bottom.
std::pair<double, double> PlaceOf(const View& view, Vec3 point) {
  const Vec3 way = point - view.eye;
  const double depth = view.perspective ? Dot(way, view.forward) : 1;
  return {0.5 + Dot(way, view.right) / (2 * depth * view.half_height * view.aspect),
          0.5 - Dot(way, view.up) / (2 * depth * view.half_height)};
}

TEST(CloseUp, ABoxFillsThePicture) {
  for (bool perspective : {true, false}) {
    View view;
    view.perspective = perspective;
    view.half_height = perspective ? 1 : 20;
    const Bounds box{{3, 1, -12}, {5, 2, -10}};
    const View near = CloseUp(view, box);
    double farthest = 0;
    for (int corner = 0; corner < 8; ++corner) {
      const auto [x, y] =
          PlaceOf(near, {corner & 1 ? 5. : 3., corner & 2 ? 2. : 1., corner & 4 ? -10. : -12.});
      farthest = std::max({farthest, std::abs(x - 0.5), std::abs(y - 0.5)});
    }
    EXPECT_LT(farthest, 0.5) << perspective;
    EXPECT_GT(farthest, 0.45) << perspective;
  }
}

TEST(CloseUp, IsNeverWiderThanTheView) {
  View view;
  view.half_height = 0.1;
  EXPECT_EQ(CloseUp(view, {{-9, -9, -12}, {9, 9, -10}}).half_height, 0.1);
}

TEST(CloseUp, OfABoxAroundTheEyeIsTheMiddle) {
  const View view;
  const View near = CloseUp(view, {{-1, -1, -1}, {1, 1, 1.5}});
  EXPECT_EQ(near.forward, view.forward);
  EXPECT_NEAR(near.half_height, view.half_height / 3, 1e-12);
}

TEST(CameraView, OpenAndExtremeAspectsBecomeDrawable) {
  Camera camera;
  camera.aspect = 0;
  EXPECT_EQ(CameraView(camera).aspect, 1.5);
  camera.aspect = 1000;
  EXPECT_EQ(CameraView(camera).aspect, 4);
}

TEST(ChooseView, TakesTheCameraOfTheScene) {
  const PatchSet patches = PatchesOf(MakeCornell());
  const View view = ViewOf(patches);
  EXPECT_EQ(view.eye, patches.cameras[0].world.translation);
  EXPECT_EQ(view.origin, "the scene's camera 'camera'");
}

TEST(ChooseView, PassesOverACameraThatSeesNothing) {
  const PatchSet patches = PatchesOf(
      SceneMaker().Box({}, {1, 1, 1}, false, {kGray}).LookFrom({5, 0, 0}, {9, 0, 0}).Make());
  EXPECT_EQ(ViewOf(patches).origin, "a view chosen outside the scene");
}

TEST(ChooseView, PassesOverCamerasThatMakeNoPicture) {
  const PatchSet good = PatchesOf(MakeCornell());
  const double kNan = std::nan("");
  std::vector<Camera> bad(5, good.cameras[0]);
  bad[0].world.translation.x = kNan;
  bad[1].world.translation.x = 1e30;
  bad[2].world.z = {};
  bad[3].yfov_rad = kNan;
  bad[4].perspective = false;
  bad[4].half_height_m = 1e30;
  for (const Camera& camera : bad) {
    PatchSet patches = good;
    patches.cameras = {camera};
    EXPECT_EQ(ViewOf(patches).origin, "a view chosen outside the scene");
  }
}

TEST(ChooseView, StandsInsideAClosedRoom) {
  const PatchSet patches = PatchesOf(MakeOffice(1));
  EXPECT_TRUE(Inside(BoundsOf(patches), ViewOf(patches).eye));
}

TEST(ChooseView, StandsOutsideAnObject) {
  const PatchSet patches = PatchesOf(SceneMaker().Box({}, {1, 1, 1}, false, {kGray}, 2).Make());
  EXPECT_FALSE(Inside(BoundsOf(patches), ViewOf(patches).eye));
}

TEST(ChooseView, LooksIntoABoxFromItsOpenSide) {
  PatchSet patches = PatchesOf(MakeCornell(2));
  patches.cameras.clear();
  const View view = ViewOf(patches);
  const Bounds box = BoundsOf(patches);
  EXPECT_GT(view.eye.z, box.Center().z);
  EXPECT_LT(view.forward.z, -0.8);
}

}  // namespace
}  // namespace lambert

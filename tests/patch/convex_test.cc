#include "radiosity/patch/convex.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

TEST(IsConvex, RoomsWithoutFurnitureAre) {
  const Paint gray{{0.5, 0.5, 0.5}, {}};
  for (int n : {1, 3}) EXPECT_TRUE(IsConvex(PatchesOf(MakeFurnace(0.5, 1, n)))) << n;
  EXPECT_TRUE(IsConvex(PatchesOf(MakeIcosphere(2, gray))));
  EXPECT_TRUE(IsConvex(PatchesOf(MakeParallelSquares(0.5, 0.5))));
}

TEST(IsConvex, WhateverCanHideSomethingIsNot) {
  const Paint gray{{0.5, 0.5, 0.5}, {}};
  EXPECT_FALSE(IsConvex(PatchesOf(MakeLShapedFurnace(0.5, 1, 2))));
  EXPECT_FALSE(IsConvex(PatchesOf(MakeCornell(1))));
  EXPECT_FALSE(IsConvex(PatchesOf(SceneMaker().Box({}, {1, 1, 1}, false, {gray}).Make())));
  // A shelf of a hair's thickness, far over the tolerance.
  EXPECT_FALSE(IsConvex(PatchesOf(SceneMaker()
                                      .Box({}, {1, 1, 1}, true, {gray})
                                      .Quad({0.2, 0.5, 0.2}, {0, 0, 0.1}, {0.1, 0, 0}, gray)
                                      .Make())));
}

TEST(IsConvex, ALightBehindAWallIsOutside) {
  const Paint gray{{0.5, 0.5, 0.5}, {}};
  const auto room = [&](Vec3 light) {
    return PatchesOf(SceneMaker().Box({}, {1, 1, 1}, true, {gray}).Light(light, {1, 1, 1}).Make());
  };
  EXPECT_TRUE(IsConvex(room({0.5, 0.5, 0.5})));
  EXPECT_FALSE(IsConvex(room({0.5, 0.5, 1.5})));
}

TEST(IsConvex, ADistantLightMustLightEveryFront) {
  PatchSet floor = PatchesOf(SceneMaker().Quad({}, {0, 0, 1}, {1, 0, 0}, {}).Make());
  floor.lights.push_back({"sun", {0, -9, 0}, {1, 1, 1}, Light::Kind::kDistant});
  floor.lights[0].z = {0.6, -0.8, 0};
  EXPECT_TRUE(IsConvex(floor));
  floor.lights[0].z = {0.6, 0.8, 0};
  EXPECT_FALSE(IsConvex(floor));
}

}  // namespace
}  // namespace lambert

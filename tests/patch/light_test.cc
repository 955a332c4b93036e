#include "radiosity/patch/light.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(SampleLight, APointLightFallsByTheSquareOfTheDistance) {
  PatchSet patches;
  patches.point_lights.push_back({"", {0, 3, 0}, {9, 18, 0}});
  ASSERT_EQ(LightCount(patches), 1);
  EXPECT_TRUE(IsDelta(patches, 0));
  const LightSample sample = SampleLight(patches, 0, {0, 0, 0}, 0.3, 0.7);
  EXPECT_EQ(sample.direction, (Vec3{0, 1, 0}));
  EXPECT_EQ(sample.distance_m, 3);
  EXPECT_EQ(sample.illuminance_lx, (Rgb{1, 2, 0}));
}

TEST(SampleLight, AtItsOwnPlaceAPointLightSendsNothing) {
  PatchSet patches;
  patches.point_lights.push_back({"", {1, 1, 1}, {9, 9, 9}});
  EXPECT_EQ(SampleLight(patches, 0, {1, 1, 1}, 0, 0).illuminance_lx, (Rgb{}));
}

}  // namespace
}  // namespace lambert

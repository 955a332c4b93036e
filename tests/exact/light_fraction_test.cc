#include "radiosity/exact/light_fraction.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

// A spot 2 m over the origin that shines down, over a floor that its patches hold once.
PatchSet UnderASpot(double cos_inner, double cos_outer) {
  PatchSet patches =
      PatchesOf(SceneMaker().Quad({-9, 0, 9}, {18, 0, 0}, {0, 0, -18}, {{}, {}}).Make());
  Light light{"spot", {0, 2, 0}, {5, 5, 5}};
  light.z = {0, -1, 0};
  light.cos_inner = cos_inner;
  light.cos_outer = cos_outer;
  patches.lights = {light};
  return patches;
}

TEST(LightFraction, OfASurfaceThatCatchesTheWholeConeIsOne) {
  const PatchSet patches = UnderASpot(0.9, 0.7);
  const Triangle all{{{-9, 0, 9}, {18, 0, 9}, {-9, 0, -18}}};
  EXPECT_NEAR(LightFraction(patches, 0).Of(all), 1, 1e-6);
}

TEST(LightFraction, OfHalfOfTheConeIsAHalf) {
  const PatchSet patches = UnderASpot(0.9, 0.7);
  const Triangle right{{{0, 0, 30}, {30, 0, 0}, {0, 0, -30}}};
  EXPECT_NEAR(LightFraction(patches, 0).Of(right), 0.5, 1e-6);
}

TEST(LightFraction, OfABackAndOfWhatIsBehindTheSpotIsNothing) {
  const PatchSet patches = UnderASpot(0.9, 0.7);
  const LightFraction fraction(patches, 0);
  EXPECT_EQ(fraction.Of({{{-9, 0, 9}, {-9, 0, -18}, {18, 0, 9}}}), 0);
  EXPECT_EQ(fraction.Of({{{-9, 4, 9}, {-9, 4, -18}, {18, 4, 9}}}), 0);
}

TEST(LightFraction, HasTheDensityOfItsParts) {
  const PatchSet patches = UnderASpot(0.9, 0.7);
  const LightFraction fraction(patches, 0);
  const Triangle small{{{0.5, 0, 0}, {0.501, 0, 0}, {0.5, 0, -0.001}}};
  EXPECT_NEAR(fraction.Of(small) / (0.5e-6 * fraction.Density({0.5, 0, 0}, {0, 1, 0})), 1, 2e-3);
  EXPECT_EQ(fraction.SeenFrom({0.5, 0, 0}), (Vec3{0, 2, 0}));
  EXPECT_EQ(fraction.place(), (Vec3{0, 2, 0}));
}

}  // namespace
}  // namespace lambert

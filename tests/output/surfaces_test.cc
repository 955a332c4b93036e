#include "radiosity/output/surfaces.h"

#include <gtest/gtest.h>

#include "tests/output/known_light.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

TEST(ListSurfaces, MeansAreWeightedByAreaAndLargestComesFirst) {
  const PatchSet patches =
      PatchesOf(SceneMaker()
                    .Quad({}, {1, 0, 0}, {0, 1, 0}, {{0.2, 0.2, 0.2}, {}}, 1, "small")
                    .Quad({5, 0, 0}, {4, 0, 0}, {0, 1, 0}, {{1, 0, 0}, {}}, 1, "")
                    .Make());
  // The large one is lit on one of its two triangles.
  bool lit = false;
  const std::vector<Surface> surfaces = ListSurfaces(patches, LitBy(patches, [&](Vec3 p) {
                                                       if (p.x < 2) return Rgb{3, 3, 3};
                                                       lit = !lit;
                                                       return lit ? Rgb{10, 10, 10} : Rgb{};
                                                     }));
  ASSERT_EQ(surfaces.size(), 2u);
  EXPECT_EQ(surfaces[0].name, "node 1");
  EXPECT_DOUBLE_EQ(surfaces[0].area_m2, 4);
  EXPECT_DOUBLE_EQ(surfaces[0].mean_lx, 5);
  EXPECT_DOUBLE_EQ(surfaces[0].least_lx, 0);
  EXPECT_DOUBLE_EQ(surfaces[0].most_lx, 10);
  EXPECT_DOUBLE_EQ(surfaces[0].mean_reflectance, 0.2126);
  EXPECT_EQ(surfaces[1].name, "small");
  EXPECT_DOUBLE_EQ(surfaces[1].mean_lx, 3);
  EXPECT_EQ(surfaces[1].patches, 2);
}

}  // namespace
}  // namespace lambert

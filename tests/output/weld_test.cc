#include "radiosity/output/weld.h"

#include <gtest/gtest.h>

#include "radiosity/core/bounds.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

TEST(Bounds, HoldAllCorners) {
  const Bounds box = BoundsOf(PatchesOf(MakeFurnace(0.5)));
  EXPECT_EQ(box.Size(), (Vec3{1, 1, 1}));
  EXPECT_DOUBLE_EQ(box.Diagonal(), std::sqrt(3.0));
  EXPECT_EQ(box.Center(), (box.low + box.high) * 0.5);
}

TEST(WeldCorners, ACubeHasEightVertices) {
  EXPECT_EQ(WeldCorners(PatchesOf(MakeFurnace(0.5))).vertex_count, 8);
}

TEST(WeldCorners, AGridOfSquaresHasItsGridPoints) {
  // n x n squares a face: 6 n^2 + 2 vertices on a cube.
  EXPECT_EQ(WeldCorners(PatchesOf(MakeFurnace(0.5, 1, 7))).vertex_count, 6 * 49 + 2);
}

TEST(WeldCorners, RoundingDoesNotPartVerticesAtAnyPlaceInTheGrid) {
  // The diagonal is about 1.7; corners are moved by 1e-7 of it, a tenth of the tolerance.
  for (int shift = 0; shift < 50; ++shift) {
    PatchSet patches = PatchesOf(MakeFurnace(0.5));
    for (PatchIndex i = 0; i < patches.size(); i += 2) {
      for (Vec3& corner : patches.corners[i]) corner.x += 1.7e-7 + shift * 1e-9;
    }
    EXPECT_EQ(WeldCorners(patches).vertex_count, 8);
  }
}

TEST(WeldCorners, PointsFartherApartStayApart) {
  PatchSet patches = PatchesOf(MakeParallelSquares(0.5, 0.5));
  const int32_t before = WeldCorners(patches).vertex_count;
  patches.corners[0][0].x += 1e-4;
  EXPECT_EQ(WeldCorners(patches).vertex_count, before + 1);
}

}  // namespace
}  // namespace lambert

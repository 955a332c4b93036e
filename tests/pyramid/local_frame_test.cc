#include "radiosity/pyramid/local_frame.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

void ExpectOrthonormal(const LocalFrame& frame) {
  EXPECT_NEAR(Length(frame.x), 1, 1e-12);
  EXPECT_NEAR(Length(frame.z), 1, 1e-12);
  EXPECT_NEAR(Dot(frame.x, frame.z), 0, 1e-12);
  EXPECT_NEAR(Length(frame.y - Cross(frame.z, frame.x)), 0, 1e-12);
}

TEST(PatchFrame, StandsOnThePatch) {
  const PatchSet patches = PatchesOf(MakeCornell(2));
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    const LocalFrame frame = PatchFrame(patches, i);
    ExpectOrthonormal(frame);
    EXPECT_EQ(frame.origin, PatchCentroid(patches, i));
    EXPECT_EQ(frame.z, PatchNormal(patches, i));
    for (const Vec3& corner : patches.corners[i]) {
      EXPECT_NEAR(frame.ToLocal(corner).z, 0, 1e-12);
    }
  }
}

TEST(PlaceFrame, AllPlacesOfAFlatSurfaceLookTheSameWay) {
  const PatchSet patches = PatchesOf(MakeOffice(2));
  const SurfaceTree tree(patches);
  int elements = 0;
  for (PatchIndex place = 0; place < tree.place_count(); ++place) {
    const LocalFrame frame = PlaceFrame(patches, tree, place);
    ExpectOrthonormal(frame);
    const int32_t surface = tree.SurfaceOf(place);
    if (surface < 0) continue;
    const LocalFrame whole = PlaceFrame(patches, tree, tree.PlaceOf(surface));
    EXPECT_GT(Dot(frame.x, whole.x), 0.98) << "normals are within ten degrees of their mean";
    EXPECT_GT(Dot(frame.z, whole.z), 0.98);
    elements += place >= patches.size();
  }
  EXPECT_GT(elements, 20);
}

TEST(PlaceFrame, APatchOfNoElementHasItsOwn) {
  const PatchSet patches = PatchesOf(MakeIcosphere(0, {{0.5, 0.5, 0.5}, {}, false}));
  const SurfaceTree tree(patches);
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    ASSERT_EQ(tree.SurfaceOf(i), -1);
    const LocalFrame own = PatchFrame(patches, i), frame = PlaceFrame(patches, tree, i);
    EXPECT_EQ(frame.x, own.x);
    EXPECT_EQ(frame.z, own.z);
    EXPECT_EQ(frame.origin, own.origin);
  }
}

}  // namespace
}  // namespace lambert

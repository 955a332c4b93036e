#include <gtest/gtest.h>

#include <algorithm>

#include "radiosity/patch/patch_set.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

PatchSet Everything() {
  Scene scene = SceneMaker()
                    .Box({}, {1, 2, 3}, true, {{{0.5, 0.6, 0.7}, {1, 2, 3}, true}})
                    .Light({0.5, 1, 1.5}, {10, 20, 30})
                    .LookFrom({0.5, 1, 2.5}, {0.5, 1, 0})
                    .Make();
  scene.warnings.push_back({"FEATURE_NOT_READ", "2 nodes have a skin"});
  Light sky{"sky", {}, {1, 1, 1}, Light::Kind::kSky};
  sky.table = *SphereTable::Create({false, 3, {-1, 1}, {0, 1}, {1, 2, 3}});
  scene.lights.push_back(sky);
  return PatchesOf(scene);
}

TEST(PatchCodec, DecodingGivesBackWhatWasEncoded) {
  const PatchSet patches = Everything();
  const std::string bytes = EncodePatchSet(patches);
  const absl::StatusOr<PatchSet> decoded = DecodePatchSet(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  EXPECT_EQ(decoded->corners, patches.corners);
  EXPECT_EQ(decoded->source, patches.source);
  EXPECT_EQ(decoded->warnings, patches.warnings);
  EXPECT_EQ(decoded->cameras.size(), 1u);
  EXPECT_EQ(decoded->lights.size(), 2u);
  EXPECT_EQ(decoded->lights[1].table->grid().values, patches.lights[1].table->grid().values);
  EXPECT_EQ(EncodePatchSet(*decoded), bytes);
}

TEST(PatchCodec, LightsOfOneTableShareIt) {
  PatchSet patches = Everything();
  const size_t once = EncodePatchSet(patches).size();
  const Light sky = patches.lights.back();
  patches.lights.insert(patches.lights.end(), 3, sky);
  Light other = sky;
  other.table = *SphereTable::Create({false, 1, {-1, 1}, {0, 1}, {4}});
  patches.lights.push_back(other);
  const std::string bytes = EncodePatchSet(patches);
  EXPECT_LT(bytes.size(), once + 5 * 200) << "names, places and axes";
  const absl::StatusOr<PatchSet> decoded = DecodePatchSet(bytes);
  ASSERT_TRUE(decoded.ok()) << decoded.status();
  const std::vector<Light>& lights = decoded->lights;
  ASSERT_EQ(lights.size(), 6u);
  for (int i = 2; i <= 4; ++i) EXPECT_EQ(lights[i].table, lights[1].table);
  EXPECT_EQ(lights[5].table->grid().values, other.table->grid().values);
  EXPECT_EQ(EncodePatchSet(*decoded), bytes);
}

TEST(PatchCodec, EmptySetTravelsToo) {
  const absl::StatusOr<PatchSet> decoded = DecodePatchSet(EncodePatchSet({}));
  ASSERT_TRUE(decoded.ok());
  EXPECT_EQ(decoded->size(), 0);
}

TEST(PatchCodec, EveryTruncationIsDataLoss) {
  const std::string bytes = EncodePatchSet(Everything());
  for (size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_EQ(DecodePatchSet(bytes.substr(0, size)).status().code(), absl::StatusCode::kDataLoss);
  }
  EXPECT_EQ(DecodePatchSet(bytes + "x").status().code(), absl::StatusCode::kDataLoss);
}

TEST(PatchCodec, EveryFlippedByteDecodesOrIsDataLoss) {
  const std::string bytes = EncodePatchSet(Everything());
  for (size_t i = 0; i < bytes.size(); ++i) {
    std::string bad = bytes;
    bad[i] = static_cast<char>(~bad[i]);
    const absl::StatusOr<PatchSet> decoded = DecodePatchSet(bad);
    if (!decoded.ok()) {
      EXPECT_EQ(decoded.status().code(), absl::StatusCode::kDataLoss);
    }
  }
}

TEST(PatchCodec, ValuesThatWouldHurtLaterAreRefused) {
  const auto expect_refused = [](const PatchSet& patches) {
    EXPECT_EQ(DecodePatchSet(EncodePatchSet(patches)).status().code(), absl::StatusCode::kDataLoss);
  };
  PatchSet patches = Everything();
  patches.area_m2[0] = 0;
  expect_refused(patches);
  patches = Everything();
  patches.twin[3] = 7;
  expect_refused(patches);
  patches = Everything();
  patches.reflectance[2].g = 1.5;
  expect_refused(patches);
  patches = Everything();
  patches.corners[1][2].x = std::nan("");
  expect_refused(patches);
  patches = Everything();
  patches.exitance_lm_per_m2[1].b = -1;
  expect_refused(patches);
  patches = Everything();
  patches.lights[0].strength.r = -1;
  expect_refused(patches);
  patches = Everything();
  patches.lights[0].kind = static_cast<Light::Kind>(77);
  expect_refused(patches);
  patches = Everything();
  patches.lights[0].z.x = 0.5;
  expect_refused(patches);
  patches = Everything();
  patches.lights[0].cos_inner = -2;
  expect_refused(patches);
  patches = Everything();
  patches.cameras[0].world.y.z = std::nan("");
  expect_refused(patches);
}

TEST(PatchCodec, AFlagIsZeroOrOne) {
  PatchSet patches = Everything();
  std::string bytes = EncodePatchSet(patches);
  patches.cameras[0].perspective = !patches.cameras[0].perspective;
  const std::string other = EncodePatchSet(patches);
  const auto flag = std::mismatch(bytes.begin(), bytes.end(), other.begin()).first;
  *flag = 2;
  EXPECT_EQ(DecodePatchSet(bytes).status().code(), absl::StatusCode::kDataLoss);
}

TEST(PatchCodec, CountsThatDoNotFitAllocateNothing) {
  std::string bytes = EncodePatchSet({});
  bytes[15] = 0x7f;  // top byte of the number of patches
  EXPECT_EQ(DecodePatchSet(bytes).status().code(), absl::StatusCode::kDataLoss);
}

}  // namespace
}  // namespace lambert

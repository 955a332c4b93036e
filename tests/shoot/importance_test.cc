#include "radiosity/shoot/importance.h"

#include <gtest/gtest.h>

#include <numeric>

#include "radiosity/core/error.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

// Two rooms of one reflectance; what is important is in the first.
struct Rooms {
  Rooms() {
    for (PatchIndex i = 0; i < patches.size(); ++i) region.push_back(patches.source[i].node == 0);
  }
  PatchSet patches = PatchesOf(MakeOffice(1));
  std::unique_ptr<RayScene> scene = *RayScene::Create(patches);
  Emitters emitters{patches, *scene};
  std::vector<uint8_t> region;
};

TEST(RegionPatches, AreThoseOfTheNamedNodesAndAnUnknownNodeNamesTheChoices) {
  const Rooms rooms;
  const auto by_index = RegionPatches(rooms.patches, {"0"});
  ASSERT_TRUE(by_index.ok());
  EXPECT_EQ(*by_index, rooms.region);
  const auto wrong = RegionPatches(rooms.patches, {"nowhere"});
  ASSERT_FALSE(wrong.ok());
  EXPECT_EQ(GetErrorDetail(wrong.status())->where, "region");
  EXPECT_NE(GetErrorDetail(wrong.status())->hint.find("name one of "), std::string::npos);
}

// In a closed box where everything is important and reflects half, W = 1 / (1 - 1/2).
TEST(RegionImportance, OfEverythingInAClosedBoxIsTheSumOfItsBounces) {
  const PatchSet patches = PatchesOf(MakeBox(2, {0.5, 0.5, 0.5}, std::vector<Rgb>(6)));
  const auto scene = *RayScene::Create(patches);
  const std::vector<double> importance = RegionImportance(
      patches, *scene, Emitters(patches, *scene), std::vector<uint8_t>(patches.size(), 1));
  double mean = 0, area = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    EXPECT_NEAR(importance[i], 2, 0.1);
    mean += importance[i] * patches.area_m2[i];
    area += patches.area_m2[i];
  }
  // The last thousandth is not followed, nor what one ray's flux rounds away at each step.
  EXPECT_NEAR(mean / area, 2, 0.004);
}

TEST(HitWorth, IsImportanceSquaredForARegionAndElseOfTheMetric) {
  const Rooms rooms;
  ShootOptions options;
  options.method = Method::kPhs;
  EXPECT_EQ(HitWorth(rooms.patches, *rooms.scene, rooms.emitters, options)->size(),
            static_cast<size_t>(rooms.patches.size()));
  options.method = Method::kImportance;
  options.region = {"0"};
  const auto worth = *HitWorth(rooms.patches, *rooms.scene, rooms.emitters, options);
  for (PatchIndex i = 0; i < rooms.patches.size(); ++i) {
    if (rooms.region[i] != 0) {
      EXPECT_GE(worth[i], 1);
    }
  }
  options.region = {"nowhere"};
  EXPECT_FALSE(HitWorth(rooms.patches, *rooms.scene, rooms.emitters, options).ok());
}

TEST(AllocationWeights, AreNoneByFluxAndElsePositiveOfMeanOneOverTheEmission) {
  const Rooms rooms;
  ShootOptions options;
  EXPECT_TRUE(AllocationWeights(rooms.patches, options)->empty());
  options.allocation = Allocation::kVariance;
  const std::vector<double> weights = *AllocationWeights(rooms.patches, options);
  double emitted = 0, weighted = 0;
  for (PatchIndex i = 0; i < rooms.patches.size(); ++i) {
    EXPECT_GT(weights[i], 0);
    const double flux = Mean(rooms.patches.exitance_lm_per_m2[i]) * rooms.patches.area_m2[i];
    emitted += flux;
    weighted += flux * weights[i];
  }
  EXPECT_NEAR(weighted / emitted, 1, 1e-12);
}

}  // namespace
}  // namespace lambert

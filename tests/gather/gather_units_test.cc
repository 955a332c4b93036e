// A gather as units of work, and its bytes.
#include "radiosity/gather/gather_units.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>

#include "radiosity/gather/gather.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

struct Case {
  std::shared_ptr<const PatchSet> patches =
      std::make_shared<const PatchSet>(PatchesOf(MakeCornell(2)));
  GatherTask task;

  Case() {
    task.options = {12, 3};
    task.first_name = 1000;
    task.radiosity_lm_per_m2 = patches->exitance_lm_per_m2;
    for (PatchIndex i = 0; i < patches->size(); ++i) {
      task.radiosity_lm_per_m2[i] = task.radiosity_lm_per_m2[i] + Rgb{1, 2, 3};
      task.points.Add(PatchCentroid(*patches, i), PatchNormal(*patches, i));
    }
  }
};

TEST(GatherUnits, MergedInAnyOrderAreTheGatherToTheBit) {
  const Case c;
  const auto shooter = *MakeGatherShooter(c.patches, c.task);
  std::vector<WorkUnit> units = CutGather(c.task.points.size(), 1 << 10);
  ASSERT_GT(units.size(), 4u);
  std::reverse(units.begin(), units.end());
  UnitResult merged;
  for (const WorkUnit& unit : units) {
    const UnitResult result = *shooter->Run(*DecodeUnit(EncodeUnit(unit)));
    EXPECT_TRUE(CheckLedger(unit, result).ok());
    const auto values = static_cast<PatchIndex>(2 * c.task.points.size());
    MergeResult(*DecodeUnitResult(EncodeUnitResult(result), values), merged);
  }
  const Gathered gathered = *GatheredOf(merged, c.task.points.size());
  const auto gatherer = *Gatherer::Create(c.patches, c.task.radiosity_lm_per_m2, c.task.options);
  const Gathered expected =
      gatherer->Run(c.task.points, 0, c.task.points.size(), c.task.first_name);
  // Both as they travel.
  EXPECT_EQ(*DecodeGathered(EncodeGathered(expected)), gathered);
  EXPECT_EQ(EncodeGathered(expected), EncodeGathered(gathered));
}

TEST(GatherUnits, UnitsOfOtherPointsAreRefused) {
  const Case c;
  const auto shooter = *MakeGatherShooter(c.patches, c.task);
  for (const Visit& visit : {Visit{0, 10, 0, 2, {}}, Visit{0, 96, 1, 2, {}}, Visit{0, 96, 4, 2, {}},
                             Visit{0, 96, 0, 98, {}}, Visit{0, 96, 0, 3, {}}}) {
    WorkUnit unit;
    unit.visits = {visit};
    EXPECT_EQ(shooter->Run(unit).status().code(), absl::StatusCode::kInvalidArgument);
  }
  GatherTask other = c.task;
  other.radiosity_lm_per_m2.pop_back();
  EXPECT_FALSE(MakeGatherShooter(c.patches, other).ok());
}

TEST(GatherUnits, AMissingPointOrAValueThatIsNoneIsSeen) {
  const Case c;
  const auto shooter = *MakeGatherShooter(c.patches, c.task);
  UnitResult whole;
  for (const WorkUnit& unit : CutGather(c.task.points.size(), 64)) {
    MergeResult(*shooter->Run(unit), whole);
  }
  ASSERT_TRUE(GatheredOf(whole, c.task.points.size()).ok());
  UnitResult missing = whole;
  missing.deposits.pop_back();
  EXPECT_FALSE(GatheredOf(missing, c.task.points.size()).ok());
  UnitResult infinite = whole;
  infinite.deposits[5].g = 0x7F800000;
  EXPECT_FALSE(GatheredOf(infinite, c.task.points.size()).ok());
}

TEST(GatherPoints, ComeBackFromTheirBytes) {
  const Case c;
  EXPECT_EQ(*DecodeGatherPoints(EncodeGatherPoints(c.task.points)), c.task.points);
  EXPECT_EQ(*DecodeGatherTask(EncodeGatherTask(c.task)), c.task);
}

TEST(GatherPoints, BytesThatAreNoneAreRefused) {
  Case c;
  const std::string task = EncodeGatherTask(c.task);
  for (size_t size = 0; size < 64; ++size) {
    EXPECT_FALSE(DecodeGatherTask(task.substr(0, task.size() - 1 - size)).ok());
    EXPECT_FALSE(DecodeGatherTask(task.substr(0, size)).ok());
    EXPECT_FALSE(DecodeGatherPoints(task.substr(size)).ok());
    EXPECT_FALSE(DecodeGathered(task.substr(size)).ok());
  }
  c.task.options.rays_per_point = 0;
  EXPECT_FALSE(DecodeGatherTask(EncodeGatherTask(c.task)).ok());
  c.task.options.rays_per_point = 1;
  c.task.radiosity_lm_per_m2[3].b = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(DecodeGatherTask(EncodeGatherTask(c.task)).ok());
  c.task.points.normal[2].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(DecodeGatherPoints(EncodeGatherPoints(c.task.points)).ok());
}

TEST(GatherPoints, ValuesTravelAsNumbersThatAreNotNegative) {
  EXPECT_EQ(TravellingFloat(-1e-20), 0);
  EXPECT_EQ(TravellingFloat(1e300), std::numeric_limits<float>::max());
  EXPECT_EQ(TravellingFloat(0.1), 0.1f);
}

}  // namespace
}  // namespace lambert

#include "app/measure.h"

#include "app/exit.h"
#include "app/measures_text.h"
#include "gtest/gtest.h"
#include "nlohmann/json.hpp"

namespace lambert::app {
namespace {

const std::vector<std::string> kNodes = {"floor", "desk", "", "desk", "7"};

TEST(FindRegions, ANameStandsForAllNodesThatHaveIt) {
  EXPECT_EQ(*FindRegions({"desk"}, kNodes), (std::set<int>{1, 3}));
}

TEST(FindRegions, ANumberIsAnIndexWhereItIsNoName) {
  EXPECT_EQ(*FindRegions({"2", "floor"}, kNodes), (std::set<int>{0, 2}));
  EXPECT_EQ(*FindRegions({"7"}, kNodes), (std::set<int>{4}));
}

TEST(FindRegions, AnUnknownNodeIsAUsageErrorWithTheNearestName) {
  for (const char* region : {"9", "-1", "", "flor"}) {
    EXPECT_EQ(ExitCodeFor(FindRegions({region}, kNodes).status()), ExitCode::kUsage) << region;
  }
  EXPECT_EQ(FindRegions({"flor"}, kNodes).status().message(),
            "--region: the scene has no node 'flor'; did you mean 'floor'");
}

TEST(Measurer, WithoutAReferenceNothingIsMeasured) {
  const auto measurer = Measurer::Create("", {});
  ASSERT_TRUE(measurer.ok());
  EXPECT_FALSE(measurer->wanted());
}

TEST(Measurer, AMissingReferenceIsToldAtOnce) {
  EXPECT_FALSE(Measurer::Create(testing::TempDir() + "/no/such.csv", {}).ok());
}

TEST(Measures, UndefinedOnesAreSaidToBe) {
  ErrorMeasures measures;
  measures.rms_area = 0.125;
  EXPECT_EQ(MeasuresText(measures).find("rms_area   0.125 "), 0u);
  EXPECT_EQ(MeasuresJson(measures).dump(),
            R"({"rms_area":0.125,"rms_patch":null,"rms_local":null,"p95":null,"power_bias":null})");
}

}  // namespace
}  // namespace lambert::app

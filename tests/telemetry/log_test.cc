#include "telemetry/log.h"

#include <gtest/gtest.h>

#include "nlohmann/json.hpp"

namespace lambert {
namespace {

TEST(Log, ALineOfTextEndsWithWhatItIsAbout) {
  EXPECT_EQ(TextOf({"lease failed: no memory", {"solveJobs/a", 7, 0, "w1"}}),
            "lease failed: no memory job=solveJobs/a step=7 unit=0 worker=w1");
  EXPECT_EQ(TextOf("stopping"), "stopping");
}

TEST(Log, ALineOfJsonHoldsTheSameAndNoMore) {
  const auto line = nlohmann::json::parse(
      "{" + JsonMembersOf({"it said \"no\"\n", {"solveJobs/a", 7, 0, "w\xff"}}) + "}");
  EXPECT_EQ(line, nlohmann::json({{"text", "it said \"no\"\n"},
                                  {"job", "solveJobs/a"},
                                  {"step", 7},
                                  {"unit", 0},
                                  {"worker", "w\ufffd"}}));
  EXPECT_EQ(JsonMembersOf("stopping"), R"("text":"stopping")");
}

}  // namespace
}  // namespace lambert

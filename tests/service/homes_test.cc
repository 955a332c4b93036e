// Where in a step each worker begins.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/work/next_leases.h"

namespace lambert::server {
namespace {

const TimePoint kNow = TimePoint() + std::chrono::hours(1);

// A step of 12 grains on workers a, b and c, of one slot each.
class Homes : public testing::Test {
 protected:
  Homes() {
    for (const char* name : {"a", "b", "c"}) {
      AddSession(state_, name, name, 1, {});
      SetWaiting(state_, name, true);
    }
    AddStep(state_, "job", 1, std::vector<int64_t>(12, 1));
    options_.max_unit_rays = 1;
  }
  // Grains in the order in which a worker gets them that is alone from now on.
  std::vector<int> Rest(const std::string& name) {
    for (const char* other : {"a", "b", "c"}) SetWaiting(state_, other, other == name);
    std::vector<int> grains;
    while (state_.steps.at("job").uncut.count() > 0) {
      const std::vector<Grant> grants = NextLeases(state_, kNow, options_);
      if (grants.empty()) break;
      const int unit = CutUnit(state_, "job", grants[0].new_grains);
      grains.push_back(grants[0].new_grains.first);
      FinishUnit(state_, {"job", unit}, "digest", name, 1, 1);
    }
    return grains;
  }
  WorkState state_;
  WorkOptions options_;
};

TEST_F(Homes, EachWorkerBeginsItsOwnStretch) {
  std::vector<int> firsts;
  for (const Grant& grant : NextLeases(state_, kNow, options_)) {
    firsts.push_back(grant.new_grains.first);
  }
  EXPECT_EQ(firsts, (std::vector<int>{0, 4, 8, 1, 5, 9}));
}

TEST_F(Homes, AreTheSameInTheNextStep) {
  const std::vector<Grant> before = NextLeases(state_, kNow, options_);
  RemoveStep(state_, "job");
  AddStep(state_, "job", 2, std::vector<int64_t>(12, 1));
  EXPECT_EQ(NextLeases(state_, kNow, options_), before);
}

TEST_F(Homes, HoldNobodyBackFromTheRest) {
  EXPECT_EQ(Rest("b"), (std::vector<int>{4, 5, 6, 7, 8, 9, 10, 11, 0, 1, 2, 3}));
}

TEST_F(Homes, OfThoseWhoLeaveAreSharedByTheOthers) {
  RemoveSession(state_, "a");
  const StepState& step = state_.steps.at("job");
  EXPECT_EQ(HomeOf(state_, step, "c"), 0);
  EXPECT_EQ(HomeOf(state_, step, "b"), 6);
}

}  // namespace
}  // namespace lambert::server

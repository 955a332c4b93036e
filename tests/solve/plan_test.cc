#include "radiosity/solve/plan.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

const PlanItem* Find(const Plan& plan, const std::string& item) {
  for (const PlanItem& i : plan.items) {
    if (i.item == item) return &i;
  }
  return nullptr;
}

// A large room with a finely cut object: areas from 9 m2 to 1e-5 m2.
PatchSet Uneven() {
  const Paint gray{{0.5, 0.5, 0.5}, {}};
  return PatchesOf(SceneMaker()
                       .Box({}, {3, 3, 3}, true, {{{0.5, 0.5, 0.5}, {1, 1, 1}}}, 1)
                       .Box({1, 1, 1}, {1.1, 1.1, 1.1}, false, {gray}, 10)
                       .Make());
}

TEST(MakePlan, ResolvesAutoByTheUnevennessOfAreas) {
  SolveOptions any;
  any.shoot.method = Method::kAuto;
  EXPECT_EQ(MakePlan(PatchesOf(MakeFurnace(0.5)), any).options.shoot.method, Method::kPmcr);
  EXPECT_EQ(MakePlan(Uneven(), any).options.shoot.method, Method::kPhs);
}

TEST(MakePlan, KeepsTheMethodThatIsAskedFor) {
  for (Method method : {Method::kPmcr, Method::kPhs}) {
    SolveOptions options;
    options.shoot.method = method;
    EXPECT_EQ(MakePlan(Uneven(), options).options.shoot.method, method);
    EXPECT_EQ(MakePlan(PatchesOf(MakeFurnace(0.5)), options).options.shoot.method, method);
  }
}

TEST(MakePlan, FillsInAGoalWhereThereIsNone) {
  const PatchSet patches = PatchesOf(MakeFurnace(0.5));
  EXPECT_EQ(MakePlan(patches, {}).options.max_error, kDefaultMaxError);
  SolveOptions rays, time, error;
  rays.max_rays = 1000;
  time.max_time_s = 5;
  error.max_error = 0.5;
  EXPECT_EQ(MakePlan(patches, rays).options.max_error, 0);
  EXPECT_EQ(MakePlan(patches, time).options.max_error, 0);
  EXPECT_EQ(MakePlan(patches, error).options.max_error, 0.5);
}

TEST(MakePlan, OptionsOfAPlanArePlannedAlike) {
  const PatchSet patches = Uneven();
  const Plan plan = MakePlan(patches, {}), again = MakePlan(patches, plan.options);
  EXPECT_EQ(again.options.shoot.method, plan.options.shoot.method);
  EXPECT_EQ(again.options.max_error, plan.options.max_error);
  EXPECT_EQ(again.first_pass_rays, plan.first_pass_rays);
  EXPECT_TRUE(plan.options.Validate().ok());
}

TEST(MakePlan, EveryItemHasAReason) {
  PatchSet patches = Uneven();
  patches.reflectance[0] = {};
  for (Method method : {Method::kAuto, Method::kPmcr, Method::kPhs}) {
    SolveOptions options;
    options.shoot.method = method;
    const Plan plan = MakePlan(patches, options);
    EXPECT_FALSE(plan.items.empty());
    for (const PlanItem& item : plan.items) {
      EXPECT_FALSE(item.item.empty());
      EXPECT_FALSE(item.reason.empty()) << item.item;
    }
    ASSERT_NE(Find(plan, "pyramids"), nullptr);
    EXPECT_EQ(Find(plan, "pyramids")->left_out, plan.options.shoot.method == Method::kPmcr);
  }
}

TEST(MakePlan, NamesBlackPatchesWithTheirNumberAndSaving) {
  PatchSet patches = PatchesOf(MakeFurnace(0.5));
  EXPECT_EQ(Find(MakePlan(patches, {}), "rays from black patches"), nullptr);
  for (PatchIndex i = 0; i < 3; ++i) patches.reflectance[i] = {};
  const Plan plan = MakePlan(patches, {});
  const PlanItem* item = Find(plan, "rays from black patches");
  ASSERT_NE(item, nullptr);
  EXPECT_TRUE(item->left_out);
  EXPECT_NE(item->reason.find("3 "), std::string::npos) << item->reason;
  EXPECT_NE(item->saving.find("25 %"), std::string::npos) << item->saving;
}

TEST(MakePlan, WorkersOfPmcrTakeUnder400BytesAPatchAndThoseOfPyramidsMore) {
  const PatchSet patches = PatchesOf(MakeCornell(20));
  SolveOptions options;
  options.shoot.method = Method::kPmcr;
  const int64_t pmcr = MakePlan(patches, options).worker_bytes;
  EXPECT_LT(pmcr, 400 * patches.size());
  options.shoot.method = Method::kPhs;
  EXPECT_GT(MakePlan(patches, options).worker_bytes, pmcr);
}

TEST(MakePlan, SizesGrowWithTheSceneAndTheFirstPassFitsTheBudget) {
  const PatchSet small = PatchesOf(MakeCornell(1)), large = PatchesOf(MakeCornell(20));
  const Plan a = MakePlan(small, {}), b = MakePlan(large, {});
  EXPECT_EQ(a.patches, small.size());
  EXPECT_EQ(b.patches, large.size());
  EXPECT_GT(b.worker_bytes, a.worker_bytes);
  EXPECT_GE(b.first_pass_rays, a.first_pass_rays);
  for (int64_t budget : {1, 3, 1000, 100000}) {
    SolveOptions options;
    options.max_rays = budget;
    const int64_t first = MakePlan(large, options).first_pass_rays;
    EXPECT_GE(first, 1);
    EXPECT_LE(first, std::max<int64_t>(1, budget / 4));
  }
}

}  // namespace
}  // namespace lambert

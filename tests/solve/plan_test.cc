#include "radiosity/solve/plan.h"

#include <gtest/gtest.h>

#include "radiosity/solve/choose_method.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

const PlanItem* Find(const Plan& plan, const std::string& part) {
  for (const PlanItem& item : plan.items) {
    if (item.part == part) return &item;
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

TEST(MakePlan, ResolvesAutoAndSaysWhy) {
  SolveOptions any;
  any.shoot.method = Method::kAuto;
  for (const PatchSet& patches : {PatchesOf(MakeFurnace(0.5)), Uneven()}) {
    const MethodChoice choice = ChooseMethod(patches, any);
    const Plan plan = MakePlan(patches, any);
    EXPECT_EQ(plan.options.shoot.method, choice.method);
    ASSERT_NE(Find(plan, "pyramids"), nullptr);
    EXPECT_EQ(Find(plan, "pyramids")->reason, choice.reason);
  }
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
      EXPECT_FALSE(item.part.empty());
      EXPECT_FALSE(item.reason.empty()) << item.item;
    }
    ASSERT_NE(Find(plan, "pyramids"), nullptr);
    EXPECT_EQ(Find(plan, "pyramids")->left_out, !UsesPyramids(plan.options.shoot.method));
  }
}

TEST(MakePlan, NamesBlackPatchesWithTheirNumberAndSaving) {
  PatchSet patches = PatchesOf(MakeFurnace(0.5));
  EXPECT_EQ(Find(MakePlan(patches, {}), "black"), nullptr);
  for (PatchIndex i = 0; i < 3; ++i) patches.reflectance[i] = {};
  const Plan plan = MakePlan(patches, {});
  const PlanItem* item = Find(plan, "black");
  ASSERT_NE(item, nullptr);
  EXPECT_TRUE(item->left_out);
  EXPECT_NE(item->reason.find("3 "), std::string::npos) << item->reason;
  EXPECT_NE(item->saving.find("25 %"), std::string::npos) << item->saving;
}

TEST(MakePlan, NamesUnlitRoomsWhereThereAreSome) {
  const Paint lamp{{0.5, 0.5, 0.5}, {1, 1, 1}}, gray{{0.5, 0.5, 0.5}, {}};
  const PatchSet patches = PatchesOf(
      SceneMaker().Box({}, {1, 1, 1}, true, {lamp}).Box({1, 0, 0}, {2, 1, 1}, true, {gray}).Make());
  EXPECT_EQ(Find(MakePlan(PatchesOf(MakeFurnace(0.5)), {}), "unlit"), nullptr);
  SolveOptions options;
  options.shoot.method = Method::kPmcr;
  EXPECT_EQ(Find(MakePlan(patches, options), "unlit"), nullptr) << "it aims at nothing";
  options.shoot.method = Method::kPhs;
  const Plan plan = MakePlan(patches, options);
  const PlanItem* item = Find(plan, "unlit");
  ASSERT_NE(item, nullptr);
  EXPECT_TRUE(item->left_out);
  EXPECT_NE(item->reason.find("12 "), std::string::npos) << item->reason;
  EXPECT_NE(item->saving.find("50 %"), std::string::npos) << item->saving;
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

// Options of a method that ask for parts.
SolveOptions Asked(Method method, std::initializer_list<Part> with,
                   std::initializer_list<Part> without = {}) {
  SolveOptions options;
  options.shoot.method = method;
  for (Part part : with) options.shoot.parts.with.Add(part);
  for (Part part : without) options.shoot.parts.without.Add(part);
  return options;
}

TEST(MakePlan, PartsThatAreAskedForAreForcedAndTheOthersAreDecided) {
  const PatchSet patches = Uneven();
  const Plan plan = MakePlan(
      patches, Asked(Method::kPhs, {Part::kDimDensities, Part::kAmbient}, {Part::kClusters}));
  EXPECT_EQ(plan.options.shoot.pyramids.min_rays, 1);
  for (const PlanItem& item : plan.items) {
    const bool with = item.part == "dim-densities" || item.part == "ambient";
    EXPECT_EQ(item.forced, with || item.part == "clusters") << item.part;
    if (item.forced) {
      EXPECT_EQ(item.left_out, !with) << item.part;
    }
  }
  const Parts& decided = plan.options.shoot.parts;
  EXPECT_TRUE(decided.with.Has(Part::kPyramids));
  EXPECT_TRUE(decided.with.Has(Part::kAmbient));
  EXPECT_TRUE(decided.without.Has(Part::kClusters));
  EXPECT_EQ(decided.with & decided.without, PartSet());
  EXPECT_TRUE(plan.options.Validate().ok());
}

TEST(MakePlan, PyramidsChooseTheMethodAndLeaveIt) {
  const PatchSet even = PatchesOf(MakeFurnace(0.5)), uneven = Uneven();
  const auto method = [](const PatchSet& patches, const SolveOptions& options) {
    return MakePlan(patches, options).options.shoot.method;
  };
  EXPECT_EQ(method(even, Asked(Method::kAuto, {Part::kPyramids})), Method::kPhs);
  EXPECT_EQ(method(uneven, Asked(Method::kAuto, {}, {Part::kPyramids})), Method::kPmcr);
  EXPECT_EQ(method(uneven, Asked(Method::kPhs, {}, {Part::kPyramids})), Method::kPmcr);
  EXPECT_EQ(method(uneven, Asked(Method::kPhsHier, {}, {Part::kPyramids})), Method::kPhsHier);
}

TEST(MakePlan, WhatOthersWouldCountOrSpreadIsLeftOutWhereItIsTheSame) {
  const PatchSet convex = PatchesOf(MakeFurnace(0.5, 1, 2)), cornell = PatchesOf(MakeCornell(1));
  EXPECT_EQ(MakePlan(convex, Asked(Method::kPhsAlpha, {})).options.shoot.method, Method::kPhs);
  EXPECT_EQ(MakePlan(convex, Asked(Method::kPhsAlpha, {Part::kAlpha})).options.shoot.method,
            Method::kPhsAlpha);
  EXPECT_EQ(MakePlan(cornell, Asked(Method::kPhsAlpha, {})).options.shoot.method,
            Method::kPhsAlpha);
  EXPECT_EQ(MakePlan(cornell, Asked(Method::kPhsHier, {})).options.shoot.method, Method::kPhsHier);
  PatchSet loose = convex;  // every patch a surface of its own
  for (PatchIndex i = 0; i < loose.size(); ++i) loose.source[i].node = i;
  EXPECT_EQ(MakePlan(loose, Asked(Method::kPhsHier, {})).options.shoot.method, Method::kPhs);
}

TEST(ValidateFor, RefusesPartsThatCannotBeOtherwiseAndSaysWhy) {
  const PatchSet patches = PatchesOf(MakeCornell(1));
  const auto message = [&](const SolveOptions& options) {
    return std::string(ValidateFor(patches, options).message());
  };
  EXPECT_EQ(message(Asked(Method::kPhs, {Part::kClusters}, {Part::kDimDensities})), "");
  EXPECT_NE(message(Asked(Method::kPmcr, {Part::kPyramids})).find("--method phs"),
            std::string::npos);
  EXPECT_NE(message(Asked(Method::kPmcr, {Part::kAlpha})).find("no such part"), std::string::npos);
  SolveOptions importance = Asked(Method::kImportance, {}, {Part::kPyramids});
  importance.shoot.region = {"0"};
  EXPECT_NE(message(importance).find("is its pyramids"), std::string::npos);
  for (Method method : {Method::kExact, Method::kPmcr}) {
    EXPECT_NE(message(Asked(method, {}, {Part::kVisibility})).find("--without visibility"),
              std::string::npos);
  }
}

TEST(ValidateFor, LooksAtTheMethodThatAdaptedPatchesGet) {
  const PatchSet patches = PatchesOf(MakeCornell(20));
  const SolveOptions options = Asked(Method::kAuto, {Part::kAmbient});
  ASSERT_EQ(MakePlan(patches, Asked(Method::kAuto, {}), true).options.shoot.method, Method::kWalk);
  EXPECT_TRUE(ValidateFor(patches, options).ok());
  const absl::Status refused = ValidateFor(patches, options, /*adapted=*/true);
  EXPECT_NE(refused.message().find("walk has no such part"), std::string::npos) << refused;
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

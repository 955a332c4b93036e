#include "radiosity/solve/choose_method.h"

#include <gtest/gtest.h>

#include "radiosity/solve/needs.h"
#include "radiosity/solve/plan.h"
#include "tests/support/scenes.h"

namespace lambert {
namespace {

SolveOptions Rays(int64_t rays) {
  SolveOptions options;
  options.max_rays = rays;
  return options;
}

Method Chosen(const PatchSet& patches, const SolveOptions& options) {
  const MethodChoice choice = ChooseMethod(patches, options);
  EXPECT_FALSE(choice.reason.empty());
  return choice.method;
}

// A cube of fine patches, over the limit of exact.
PatchSet Fine() { return PatchesOf(MakeFurnace(0.5, 1, 24)); }

TEST(ChooseMethod, ClosedFormsWhereNothingHides) {
  const PatchSet cube = PatchesOf(MakeFurnace(0.5, 1, 4));
  EXPECT_EQ(Chosen(cube, {}), Method::kExact);
  EXPECT_EQ(Chosen(cube, Rays(10)), Method::kExact) << "not one of them is needed";
  SolveOptions hurry;
  hurry.max_time_s = 0.01;
  EXPECT_NE(Chosen(cube, hurry), Method::kExact) << "192 patches take longer";
  hurry.max_time_s = 1;
  EXPECT_EQ(Chosen(cube, hurry), Method::kExact);
}

TEST(ChooseMethod, WalksWherePatchesAreSplitForTheLightAndSomeOfItIsLost) {
  const PatchSet room = PatchesOf(MakeOffice(1)), stiff = PatchesOf(MakeFurnace(0.999, 1, 24));
  EXPECT_FALSE(IsStiff(room));
  EXPECT_TRUE(IsStiff(stiff));
  EXPECT_EQ(ChooseMethod(room, {}, /*adapted=*/true).method, Method::kWalk);
  EXPECT_NE(ChooseMethod(stiff, {}, /*adapted=*/true).method, Method::kWalk);
  SolveOptions open;
  open.shoot.method = Method::kAuto;
  EXPECT_EQ(MakePlan(room, open, /*adapted=*/true).options.shoot.method, Method::kWalk);
  EXPECT_NE(Chosen(room, {}), Method::kWalk);
}

TEST(ChooseMethod, ClosedFormsWhereTheyCostLessThanTheNoise) {
  const PatchSet room = PatchesOf(MakeOffice(1));  // 222 patches
  EXPECT_EQ(Chosen(room, {}), Method::kExact);
  EXPECT_EQ(Chosen(room, Rays(1000000)), Method::kExact);
  EXPECT_NE(Chosen(room, Rays(1000)), Method::kExact);
  SolveOptions coarse;
  coarse.max_error = 0.5;
  EXPECT_NE(Chosen(room, coarse), Method::kExact);
}

TEST(ChooseMethod, RaysWhereClosedFormsAreInDoubt) {
  PatchSet room = PatchesOf(MakeOffice(1));
  for (const char* reason : {"COPLANAR_OVERLAP", "LIGHT_ON_SURFACE"}) {
    room.warnings = {{reason, "which of them light meets is left to chance"}};
    EXPECT_NE(Chosen(room, Rays(1000000)), Method::kExact);
  }
}

TEST(ChooseMethod, NeighboursShareTheirLightWhereRaysAreFew) {
  const PatchSet fine = Fine();
  ASSERT_GT(fine.size(), kMaxExactPatches);
  EXPECT_EQ(Chosen(fine, Rays(20 * fine.size())), Method::kPhsHier);
  EXPECT_EQ(Chosen(fine, Rays(1000 * fine.size())), Method::kPmcr);
  EXPECT_EQ(Chosen(fine, {}), Method::kPmcr) << "3 % take about 700 rays a patch";
  SolveOptions flat = Rays(20 * fine.size());
  flat.shoot.parts.without.Add(Part::kHierarchy);
  EXPECT_EQ(Chosen(fine, flat), Method::kPmcr);
}

TEST(ChooseMethod, NothingIsSharedWhereEveryPatchIsOfAnotherColor) {
  PatchSet textured = Fine();
  for (PatchIndex i = 0; i < textured.size(); ++i) {
    textured.reflectance[i].r = 0.9 * i / textured.size();
  }
  EXPECT_EQ(Chosen(textured, Rays(20 * textured.size())), Method::kPmcr);
}

}  // namespace
}  // namespace lambert

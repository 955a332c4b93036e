#include "radiosity/shoot/light_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

std::vector<int32_t> GroupsOf(const PatchSet& patches) {
  return FindLightGroups(patches, **RayScene::Create(patches));
}

TEST(FindLightGroups, ARoomIsOneGroup) {
  const PatchSet patches = PatchesOf(MakeCornell(2));
  EXPECT_EQ(GroupsOf(patches), std::vector<int32_t>(patches.size(), 0));
}

TEST(FindLightGroups, RoomsWithoutADoorAreApartAndOutsidesAlone) {
  const Paint paint{{0.5, 0.5, 0.5}, {1, 1, 1}};
  const PatchSet patches = PatchesOf(SceneMaker()
                                         .Box({0, 0, 0}, {1, 1, 1}, true, {paint})
                                         .Box({1, 0, 0}, {2, 1, 1}, true, {paint})
                                         .Box({5, 0, 0}, {6, 1, 1}, false, {paint})
                                         .Make());
  const std::vector<int32_t> group = GroupsOf(patches);
  // Of the first room, of the second, and twelve triangles that see nothing.
  EXPECT_EQ(*std::max_element(group.begin(), group.end()), 13);
  int32_t next = 0;
  for (PatchIndex i = 0; i < patches.size(); ++i) {
    EXPECT_LE(group[i], next) << "numbered in order of their first patches";
    next = std::max(next, group[i] + 1);
    for (PatchIndex j = 0; j < i; ++j) {
      const int32_t node_i = patches.source[i].node, node_j = patches.source[j].node;
      EXPECT_EQ(group[i] == group[j], node_i == node_j && node_i < 2) << i << ' ' << j;
    }
  }
}

TEST(LightGroupRays, AreAMillionOrSixteenOfEveryPatch) {
  EXPECT_EQ(LightGroupRays(1), 1024);
  EXPECT_EQ(LightGroupRays(1 << 14), 1 << 20);
  EXPECT_EQ(LightGroupRays(1'000'000), 16'000'000);
}

}  // namespace
}  // namespace lambert

#include "radiosity/patch/patch_set.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace lambert {
namespace {

TEST(NodesCalled, TakesNamesBeforeIndicesAndEveryNodeOfAName) {
  const std::vector<std::string> names = {"desk", "2", "lamp", "desk", ""};
  EXPECT_EQ(NodesCalled(names, "desk"), (std::vector<int32_t>{0, 3}));
  EXPECT_EQ(NodesCalled(names, "2"), std::vector<int32_t>{1});
  EXPECT_EQ(NodesCalled(names, "4"), std::vector<int32_t>{4});
}

TEST(NodesCalled, FindsNoneForWhatIsNeither) {
  const std::vector<std::string> names = {"desk", ""};
  for (const char* name : {"", "2", "-1", "0x", "des", "99999999999"}) {
    EXPECT_EQ(NodesCalled(names, name), std::vector<int32_t>{}) << name;
  }
}

TEST(PatchSet, TheDiagonalIsThatOfAllPatches) {
  EXPECT_DOUBLE_EQ(BoundsOf(PatchesOf(MakeOffice(1))).Diagonal(), std::sqrt(36 + 9 + 64));
}

}  // namespace
}  // namespace lambert

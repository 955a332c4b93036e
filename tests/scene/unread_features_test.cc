#include "radiosity/scene/unread_features.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(UnreadFeatures, EachFeatureIsNamedOnceWithItsCount) {
  UnreadFeatures unread;
  EXPECT_TRUE(unread.Warnings().empty());
  unread.Add("skins", "node", "shown at rest");
  unread.Add("alpha mode BLEND", "material", "taken as opaque");
  unread.Add("skins", "node", "shown at rest");
  EXPECT_EQ(
      unread.Warnings(),
      (std::vector<Warning>{{"FEATURE_NOT_READ", "alpha mode BLEND (1 material): taken as opaque"},
                            {"FEATURE_NOT_READ", "skins (2 nodes): shown at rest"}}));
}

}  // namespace
}  // namespace lambert

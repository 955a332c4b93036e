#include "radiosity/core/disjoint_sets.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(DisjointSets, AreKnownByTheirLeastMembers) {
  DisjointSets sets(8);
  for (int32_t i = 0; i < 8; ++i) EXPECT_EQ(sets.Find(i), i);
  sets.Join(6, 3);
  sets.Join(7, 6);
  sets.Join(2, 5);
  sets.Join(2, 2);
  for (int32_t i : {3, 6, 7}) EXPECT_EQ(sets.Find(i), 3);
  for (int32_t i : {2, 5}) EXPECT_EQ(sets.Find(i), 2);
  sets.Join(5, 7);
  for (int32_t i : {2, 3, 5, 6, 7}) EXPECT_EQ(sets.Find(i), 2);
  for (int32_t i : {0, 1, 4}) EXPECT_EQ(sets.Find(i), i);
}

}  // namespace
}  // namespace lambert

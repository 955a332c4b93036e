#include "app/live.h"

#include <gtest/gtest.h>

namespace lambert::app {
namespace {

TEST(FitScreen, LeavesAloneWhatFits) {
  EXPECT_EQ(FitScreen("one\ntwo\n", 2, 3), "one\ntwo\n");
  EXPECT_EQ(FitScreen("", 2, 3), "");
}

TEST(FitScreen, CutsLinesAtWholeCharacters) {
  EXPECT_EQ(FitScreen("caf\xc3\xa9s\n", 1, 4), "caf\xc3\xa9\n");
  EXPECT_EQ(FitScreen("caf\xc3\xa9s\n", 1, 3), "caf\n");
}

TEST(FitScreen, SaysHowManyLinesAreLeftOut) {
  EXPECT_EQ(FitScreen("1\n2\n3\n4\n", 3, 20), "1\n2\n... and 2 more\n");
  EXPECT_EQ(FitScreen("1\n2\n3\n", 1, 20), "... and 3 more\n");
}

}  // namespace
}  // namespace lambert::app

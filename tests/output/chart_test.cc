#include "radiosity/output/chart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace lambert {
namespace {

TEST(EscapeHtml, LeavesNothingThatAPageCouldRead) {
  EXPECT_EQ(EscapeHtml("<a href=\"x\">'&'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

TEST(LogLogChart, AStraightPowerLawIsAStraightLine) {
  const std::string svg =
      LogLogChart({{"error", "estimate", {1, 10, 100}, {1, 0.1, 0.01}}}, "s", "error", 0, "");
  // Axes 1..100 s and 1..100 %: the middle point lies in the middle of the drawing.
  EXPECT_NE(svg.find("points=\"64,16 382,154 700,292 \""), std::string::npos) << svg;
}

TEST(LogLogChart, PointsThatALogarithmCannotShowAreLeftOut) {
  const std::vector<double> x = {0, 1, 2, 3, 4}, y = {1, -1, std::nan(""), 0.5, 0.2};
  const std::string svg = LogLogChart({{"error", "estimate", x, y}}, "s", "error", 0, "");
  size_t circles = 0;
  for (size_t at = svg.find("<circle"); at != std::string::npos; at = svg.find("<circle", at + 1)) {
    ++circles;
  }
  EXPECT_EQ(circles, 2u);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(LogLogChart, OnePointIsNoCurve) {
  EXPECT_EQ(LogLogChart({{"error", "estimate", {1}, {1}}}, "s", "error", 0.1, "goal"), "");
  EXPECT_EQ(LogLogChart({}, "s", "error", 0.1, "goal"), "");
}

TEST(LogLogChart, HugeRangesEndAndKeepFewTicks) {
  const std::string svg =
      LogLogChart({{"error", "estimate", {1e-300, 1e300}, {1e-300, 1}}}, "s", "error", 0, "");
  EXPECT_LT(svg.size(), 10000u);
}

}  // namespace
}  // namespace lambert

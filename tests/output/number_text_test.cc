#include "radiosity/output/number_text.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace lambert {
namespace {

TEST(AppendNumber, IsTheShortestThatReadsBack) {
  for (double value : {0.1, 1 / 3.0, 1e300, -2.5, 5e-324, 123456789.0}) {
    std::string text;
    AppendNumber(value, text);
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value);
  }
  std::string text = "x";
  AppendNumber(0.1, text);
  AppendNumber(std::numeric_limits<uint64_t>::max(), text);
  EXPECT_EQ(text, "x0.118446744073709551615");
}

TEST(RoundedText, KeepsSignificantDigits) {
  EXPECT_EQ(RoundedText(0.031234, 3), "0.0312");
  EXPECT_EQ(RoundedText(1234567, 2), "1.2e+06");
  EXPECT_EQ(RoundedText(2, 4), "2");
}

}  // namespace
}  // namespace lambert

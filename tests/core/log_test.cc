#include "radiosity/core/log.h"

#include <gtest/gtest.h>

namespace lambert {
namespace {

TEST(LogLine, IsATextAndWhatItIsAbout) {
  const LogLine plain = "stopping", about(std::string("lease failed"), {.job = "a", .unit = 3});
  EXPECT_EQ(plain.text, "stopping");
  EXPECT_EQ(plain.about.job, "");
  EXPECT_EQ(plain.about.step, -1);
  EXPECT_EQ(about.text, "lease failed");
  EXPECT_EQ(about.about.job, "a");
  EXPECT_EQ(about.about.step, -1);
  EXPECT_EQ(about.about.unit, 3);
}

}  // namespace
}  // namespace lambert

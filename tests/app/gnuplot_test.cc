#include "app/gnuplot.h"

#include <filesystem>
#include <fstream>

#include "gtest/gtest.h"
#include "radiosity/core/error.h"
#include "tests/support/temporary_folder.h"

namespace lambert::app {
namespace {

class GnuplotTest : public testing::Test {
 protected:
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + "/" + name) << text;
  }

  const TemporaryFolder own_;
  const std::string folder_ = own_.path();
};

TEST_F(GnuplotTest, QuotesHoldAnyText) {
  EXPECT_EQ(GnuplotQuoted("it's a \"room\"\n`ls`"), "'it''s a \"room\" `ls`'");
}

TEST_F(GnuplotTest, AScriptMakesOnePictureForEachFormat) {
  Write("line.gp", GnuplotTerminal("line", 200, 150) + GnuplotLineTypes() + "plot x lt 24\n");
  const absl::Status status = RunGnuplot(folder_, "line.gp", {"png", "svg"});
  ASSERT_TRUE(status.ok()) << status;
  EXPECT_GT(std::filesystem::file_size(folder_ + "/line.png"), 100u);
  EXPECT_GT(std::filesystem::file_size(folder_ + "/line.svg"), 100u);
}

TEST_F(GnuplotTest, WhatGnuplotDoesNotLikeIsAnErrorWithItsWords) {
  Write("bad.gp", "plto x\n");
  const absl::Status status = RunGnuplot(folder_, "bad.gp", {"png"});
  ASSERT_TRUE(GetErrorDetail(status));
  EXPECT_EQ(ReasonOf(status), "GNUPLOT_FAILED");
  EXPECT_NE(status.message().find("bad.gp"), std::string::npos);
  EXPECT_NE(status.message().find("plto"), std::string::npos) << status;
}

}  // namespace
}  // namespace lambert::app

#include "app/progress.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "app/progress_text.h"
#include "gtest/gtest.h"
#include "nlohmann/json.hpp"

namespace lambert::app {
namespace {

Progress HalfWay() {
  Progress progress;
  progress.pass = 11;
  progress.rays = 3'420'000;
  progress.seconds = 2;
  progress.unsent_fraction = 0.003;
  progress.estimated_rms_area = 0.02;
  progress.wanted_rms_area = 0.01;
  return progress;
}

// What a printer wrote, with a clock that the test moves.
class Printed {
 public:
  explicit Printed(ProgressMode mode)
      : stream_(open_memstream(&text_, &size_)),
        printer_(mode, stream_, [this] { return now_s; }) {}
  ~Printed() {
    printer_.Finish();
    std::fclose(stream_);
    std::free(text_);
  }
  ProgressPrinter& printer() { return printer_; }
  std::string text() {
    std::fflush(stream_);
    return {text_, size_};
  }
  double now_s = 100;

 private:
  char* text_ = nullptr;
  size_t size_ = 0;
  std::FILE* stream_;
  ProgressPrinter printer_;
};

TEST(ProgressText, NumbersHaveThreeDigitsAndAUnit) {
  EXPECT_EQ(FormatCount(950, "rays"), "950 rays");
  EXPECT_EQ(FormatCount(12'345, "rays"), "12.3 krays");
  EXPECT_EQ(FormatCount(999'900, "rays"), "1.00 Mrays");
  EXPECT_EQ(FormatPercent(1), "100 %");
  EXPECT_EQ(FormatPercent(0.021), "2.1 %");
  EXPECT_EQ(FormatPercent(0.0097), "0.97 %");
  EXPECT_EQ(FormatDuration(0.4), "0.40 s");
  EXPECT_EQ(FormatDuration(184), "3 min 04 s");
  EXPECT_EQ(FormatDuration(7620), "2 h 07 min");
  EXPECT_EQ(FormatDuration(3 * 86400), "3 days");
  EXPECT_EQ(FormatBytes(3 << 20), "3.00 MiB");
}

TEST(ProgressText, ALineSaysAllThatIsKnown) {
  EXPECT_EQ(DescribeProgress(HalfWay(), 0),
            "pass 12  error 2.0 % -> 1.0 %  6.0 s left  3.42 Mrays  1.71 Mrays/s  unsent 0.3 %");
}

TEST(ProgressText, TheErrorFallsWithTheRootOfTheRays) {
  // Half the error takes four times the rays: a quarter is done, three times as long is left.
  EXPECT_DOUBLE_EQ(EstimateFractionDone(HalfWay(), 0), 0.25);
  EXPECT_DOUBLE_EQ(EstimateSecondsLeft(HalfWay(), 0), 6);
}

TEST(ProgressText, TheNearestStopRuleDecides) {
  EXPECT_DOUBLE_EQ(EstimateSecondsLeft(HalfWay(), 4), 2);
  Progress progress = HalfWay();
  progress.max_rays = 4 * progress.rays / 3;
  EXPECT_NEAR(EstimateFractionDone(progress, 0), 0.75, 1e-12);
}

TEST(ProgressText, NothingIsSaidOfWhatIsNotKnown) {
  EXPECT_EQ(EstimateSecondsLeft(Progress(), 0), -1);
  EXPECT_EQ(DescribeProgress(Progress(), 0).find("error"), std::string::npos);
}

TEST(ProgressText, ABarFitsItsTerminal) {
  EXPECT_EQ(DrawProgressBar(HalfWay(), 0, 200).find("[=====               ]  25 %  pass 12"), 0u);
  EXPECT_EQ(DrawProgressBar(HalfWay(), 0, 90).find("25 %  pass 12  error 2.0 % -> 1.0 %"), 0u);
  EXPECT_EQ(DrawProgressBar(HalfWay(), 0, 30).size(), 30u);
  EXPECT_EQ(DrawProgressBar(HalfWay(), 0, -1), "");
}

TEST(ProgressPrinter, PlainLinesComeOnceASecondAndTheLastIsNotLost) {
  Printed printed(ProgressMode::kPlain);
  Progress progress = HalfWay();
  for (int i = 0; i < 15; ++i) {
    progress.pass = i;
    printed.printer().Update(progress);
    printed.now_s += 0.125;
  }
  printed.printer().Finish();
  const std::string text = printed.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);
  EXPECT_EQ(text.find("pass 1  "), 0u);
  EXPECT_NE(text.find("pass 9  "), std::string::npos);
  EXPECT_NE(text.find("pass 15  "), std::string::npos);
}

TEST(ProgressPrinter, ABarStaysOnOneLineAndNotesStandAboveIt) {
  Printed printed(ProgressMode::kBar);
  printed.printer().Update(HalfWay());
  printed.printer().Note("warning: something");
  printed.now_s += 1;
  printed.printer().Update(HalfWay());
  printed.printer().Finish();
  const std::string text = printed.text();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);  // after the note, and at the end
  EXPECT_NE(text.find("\r\033[Kwarning: something\n25 %"), std::string::npos) << text;
}

TEST(ProgressPrinter, JsonLinesAreJson) {
  Printed printed(ProgressMode::kJson);
  printed.printer().Stage("uploading \"room\"");
  printed.printer().Update(HalfWay());
  const std::string text = printed.text();
  const size_t end = text.find('\n');
  EXPECT_EQ(nlohmann::json::parse(text.substr(0, end))["stage"], "uploading \"room\"");
  const auto line = nlohmann::json::parse(text.substr(end + 1))["progress"];
  EXPECT_EQ(line["rays"], 3'420'000);
  EXPECT_EQ(line["estimated_rms_area"], 0.02);
  EXPECT_TRUE(line["estimated_rms_patch"].is_null());
}

TEST(ProgressPrinter, NoneIsSilentButForNotes) {
  Printed printed(ProgressMode::kNone);
  printed.printer().Stage("uploading");
  printed.printer().Update(HalfWay());
  printed.printer().Note("warning: something");
  printed.printer().Finish();
  EXPECT_EQ(printed.text(), "warning: something\n");
}

TEST(ProgressMode, IsPlainWhereThereIsNoTerminal) {
  std::FILE* file = std::tmpfile();
  EXPECT_EQ(ResolveProgressMode(ProgressMode::kAuto, file), ProgressMode::kPlain);
  EXPECT_EQ(ResolveProgressMode(ProgressMode::kBar, file), ProgressMode::kBar);
  std::fclose(file);
}

}  // namespace
}  // namespace lambert::app

#include "app/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <utility>

#include "app/progress_text.h"
#include "nlohmann/json.hpp"

namespace lambert::app {
namespace {

constexpr double kFastInterval_s = 0.1;   // a bar that people watch, a program that reads JSON
constexpr double kPlainInterval_s = 1.0;  // lines that stay in a log
constexpr int kDefaultColumns = 80;

int TerminalColumns(std::FILE* stream) {
  winsize size{};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kDefaultColumns;
  return size.ws_col;
}

nlohmann::ordered_json OrNull(double value) {
  return value < 0 ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(value);
}

std::string JsonLine(const Progress& progress, double max_time_s) {
  const nlohmann::ordered_json line = {
      {"progress",
       {{"pilot", progress.pilot},
        {"pass", progress.pass},
        {"step", progress.step},
        {"rays", progress.rays},
        {"seconds", progress.seconds},
        {"cpu_seconds", progress.cpu_seconds},
        {"unsent_fraction", progress.unsent_fraction},
        {"estimated_rms_area", OrNull(progress.estimated_rms_area)},
        {"estimated_rms_patch", OrNull(progress.estimated_rms_patch)},
        {"wanted_rms_area", progress.wanted_rms_area},
        {"seconds_left", OrNull(EstimateSecondsLeft(progress, max_time_s))}}}};
  return line.dump();
}

}  // namespace

double MonotonicSeconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ProgressMode ResolveProgressMode(ProgressMode mode, std::FILE* stream) {
  if (mode != ProgressMode::kAuto) return mode;
  const char* terminal = std::getenv("TERM");
  const bool can_draw = terminal != nullptr && std::string(terminal) != "dumb";
  return isatty(fileno(stream)) && can_draw ? ProgressMode::kBar : ProgressMode::kPlain;
}

ProgressPrinter::ProgressPrinter(ProgressMode mode, std::FILE* stream,
                                 std::function<double()> seconds_now)
    : mode_(mode), stream_(stream), seconds_now_(std::move(seconds_now)) {}

void ProgressPrinter::SetTimeBudget(double max_time_s) {
  std::lock_guard lock(mutex_);
  max_time_s_ = max_time_s;
}

void ProgressPrinter::Stage(const std::string& text) {
  std::lock_guard lock(mutex_);
  if (mode_ == ProgressMode::kNone) return;
  if (mode_ == ProgressMode::kJson) {
    DrawLine(nlohmann::ordered_json{{"stage", text}}.dump());
  } else {
    DrawLine(text);
  }
}

void ProgressPrinter::Update(const Progress& progress) {
  std::lock_guard lock(mutex_);
  if (mode_ == ProgressMode::kNone || progress.rays == 0) return;
  last_ = progress;
  const double interval_s = mode_ == ProgressMode::kPlain ? kPlainInterval_s : kFastInterval_s;
  held_back_ = seconds_now_() - drawn_at_s_ < interval_s;
  if (!held_back_) Draw(progress);
}

void ProgressPrinter::Note(const std::string& line) {
  std::lock_guard lock(mutex_);
  ClearLine();
  std::fprintf(stream_, "%s\n", line.c_str());
  std::fflush(stream_);
}

void ProgressPrinter::Finish() {
  std::lock_guard lock(mutex_);
  if (held_back_) Draw(last_);
  held_back_ = false;
  if (line_open_) std::fputc('\n', stream_);
  line_open_ = false;
  std::fflush(stream_);
}

void ProgressPrinter::Draw(const Progress& progress) {
  drawn_at_s_ = seconds_now_();
  switch (mode_) {
    case ProgressMode::kBar:
      // One column stays free: a full line would wrap on some terminals.
      DrawLine(DrawProgressBar(progress, max_time_s_, TerminalColumns(stream_) - 1));
      break;
    case ProgressMode::kJson:
      DrawLine(JsonLine(progress, max_time_s_));
      break;
    default:
      DrawLine(DescribeProgress(progress, max_time_s_));
  }
}

void ProgressPrinter::DrawLine(const std::string& line) {
  ClearLine();
  line_open_ = mode_ == ProgressMode::kBar;
  std::fprintf(stream_, line_open_ ? "%s" : "%s\n", line.c_str());
  std::fflush(stream_);
}

void ProgressPrinter::ClearLine() {
  if (line_open_) std::fputs("\r\033[K", stream_);
  line_open_ = false;
}

}  // namespace lambert::app

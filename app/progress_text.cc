#include "app/progress_text.h"

#include <algorithm>
#include <cmath>

#include "fmt/format.h"

namespace lambert::app {
namespace {

constexpr int kBarColumns = 20;
constexpr double kLongestForecast_s = 30 * 86400.0;  // more is as good as never

// Three significant digits without an exponent.
std::string ThreeDigits(double value) {
  if (value >= 100) return fmt::format("{:.0f}", value);
  if (value >= 10) return fmt::format("{:.1f}", value);
  return fmt::format("{:.2f}", value);
}

bool WantsError(const Progress& progress) {
  return progress.wanted_rms_area > 0 && progress.estimated_rms_area > 0;
}

}  // namespace

std::string FormatCount(double count, const std::string& unit) {
  if (count < 999.5) return fmt::format("{:.0f} {}", count, unit);
  if (count < 999.5e3) return ThreeDigits(count / 1e3) + " k" + unit;
  if (count < 999.5e6) return ThreeDigits(count / 1e6) + " M" + unit;
  return ThreeDigits(count / 1e9) + " G" + unit;
}

std::string FormatPercent(double fraction) {
  const double percent = fraction * 100;
  if (percent >= 9.95) return fmt::format("{:.0f} %", percent);
  if (percent >= 0.995) return fmt::format("{:.1f} %", percent);
  return fmt::format("{:.2g} %", percent);
}

std::string FormatDuration(double seconds) {
  if (seconds < 0.995) return fmt::format("{:.2f} s", seconds);
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<int64_t>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  if (whole < 48 * 3600) return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
  return fmt::format("{} days", whole / 86400);
}

std::string FormatBytes(int64_t bytes) {
  const double value = static_cast<double>(bytes);
  if (value < 1024) return fmt::format("{} B", bytes);
  if (value < 1024.0 * 1024) return ThreeDigits(value / 1024) + " KiB";
  if (value < 1024.0 * 1024 * 1024) return ThreeDigits(value / (1024 * 1024)) + " MiB";
  return ThreeDigits(value / (1024.0 * 1024 * 1024)) + " GiB";
}

double EstimateFractionDone(const Progress& progress, double max_time_s) {
  double done = 0;
  if (WantsError(progress)) {
    // error ~ 1 / sqrt(rays): the share of the rays that the wanted error will have taken.
    const double ratio = progress.wanted_rms_area / progress.estimated_rms_area;
    done = std::max(done, ratio * ratio);
  }
  if (progress.max_rays > 0) {
    done = std::max(done, static_cast<double>(progress.rays) / progress.max_rays);
  }
  if (max_time_s > 0) done = std::max(done, progress.seconds / max_time_s);
  return std::clamp(done, 0.0, 1.0);
}

double EstimateSecondsLeft(const Progress& progress, double max_time_s) {
  const double done = EstimateFractionDone(progress, max_time_s);
  if (done <= 0 || progress.seconds <= 0) return -1;
  return progress.seconds * (1 / done - 1);
}

std::string DescribeProgress(const Progress& progress, double max_time_s) {
  if (progress.pilot > 0) {
    return fmt::format("meshing: pilot {} of {} patches, {}", progress.pilot,
                       progress.pilot_patches,
                       FormatCount(static_cast<double>(progress.rays), "rays"));
  }
  std::string text = fmt::format("pass {}", progress.pass + 1);
  const std::string wanted =
      progress.wanted_rms_area > 0 ? " -> " + FormatPercent(progress.wanted_rms_area) : "";
  if (progress.estimated_rms_area >= 0) {
    text += "  error " + FormatPercent(progress.estimated_rms_area) + wanted;
  } else if (!wanted.empty()) {
    text += "  error ?" + wanted;
  }
  const double left_s = EstimateSecondsLeft(progress, max_time_s);
  if (left_s >= 0 && left_s < kLongestForecast_s) text += "  " + FormatDuration(left_s) + " left";
  const auto rays = static_cast<double>(progress.rays);
  text += "  " + FormatCount(rays, "rays");
  if (progress.seconds > 0) text += "  " + FormatCount(rays / progress.seconds, "rays/s");
  return text + "  unsent " + FormatPercent(progress.unsent_fraction);
}

std::string DrawProgressBar(const Progress& progress, double max_time_s, int width) {
  const auto columns = static_cast<size_t>(std::max(width, 0));
  const double done = EstimateFractionDone(progress, max_time_s);
  const int filled = static_cast<int>(done * kBarColumns);
  const std::string text = DescribeProgress(progress, max_time_s);
  std::string line = fmt::format("[{:<{}}] {:3.0f} %  {}", std::string(filled, '='), kBarColumns,
                                 done * 100, text);
  // Where not all has room, the words tell more than the bar.
  if (line.size() > columns) line = fmt::format("{:.0f} %  {}", done * 100, text);
  if (line.size() > columns) line.resize(columns);
  return line;
}

}  // namespace lambert::app

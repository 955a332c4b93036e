// Progress on standard error: a bar, plain lines, JSON lines, or nothing.
#pragma once

#include <cstdio>
#include <functional>
#include <mutex>
#include <string>

#include "app/options.h"
#include "radiosity/core/warning.h"
#include "radiosity/solve/solution.h"

namespace lambert::app {

// Monotonic seconds since some moment.
double MonotonicSeconds();

// kAuto becomes kBar where `stream` is a terminal that can move its cursor, else kPlain.
ProgressMode ResolveProgressMode(ProgressMode mode, std::FILE* stream);

// Any thread. The bar's width follows the terminal at every drawing.
class ProgressPrinter {
 public:
  // Requires: mode is not kAuto. `seconds_now`: monotonic seconds.
  ProgressPrinter(ProgressMode mode, std::FILE* stream, std::function<double()> seconds_now);
  ~ProgressPrinter() { Finish(); }

  // Seconds that the run may take; 0: as many as it needs.
  void SetTimeBudget(double max_time_s);

  // What happens before rays fly: "uploading room.glb, 3.1 of 12.4 MiB".
  void Stage(const std::string& text);
  // At most ten drawings of a bar, or ten JSON lines, and one plain line a second.
  void Update(const Progress& progress);
  // A line that stays, whatever the mode: "warning: ..."
  void Note(const std::string& line);
  void Warn(const Warning& warning) { Note("warning: " + warning.message); }
  // Prints the last update if it was held back, and leaves the cursor on a fresh line.
  void Finish();

 private:
  void Draw(const Progress& progress);
  void DrawLine(const std::string& line);
  void ClearLine();

  const ProgressMode mode_;
  std::FILE* const stream_;
  const std::function<double()> seconds_now_;

  std::mutex mutex_;  // guards all below
  double max_time_s_ = 0;
  double drawn_at_s_ = -1e9;
  bool line_open_ = false;  // a bar stands on the last line
  bool held_back_ = false;  // last_ is not drawn yet
  Progress last_;
};

}  // namespace lambert::app

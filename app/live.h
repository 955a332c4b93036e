// A table that is printed once, or kept up to date until Ctrl-C.
#pragma once

#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "app/exit.h"
#include "app/interrupt.h"

namespace lambert::app {

// Prints on standard output what `draw` returns: lines, each with its end. With `watch` again each
// second: on a terminal in place, elsewhere below, where it changed. Ctrl-C ends that with
// kInterrupted; what was there last stays. An error of `draw` ends it too.
absl::StatusOr<ExitCode> ShowTable(bool watch, Interrupt& interrupt,
                                   const std::function<absl::StatusOr<std::string>()>& draw);

// The part of `text` that a screen of that size holds, from its top left: whole characters of
// UTF-8, one column each. A line that is left out is told in the last row.
std::string FitScreen(const std::string& text, int rows, int columns);

}  // namespace lambert::app

// How the command ends: exit codes and the one line that says what went wrong.
#pragma once

#include <string>

#include "absl/status/status.h"

namespace lambert::app {

enum class ExitCode : int {
  kDone = 0,
  kFailed = 1,
  kUsage = 2,
  kBadScene = 3,
  kNoServer = 4,
  kBudgetSpent = 5,    // before the wanted error; the result is kept
  kInterrupted = 130,  // Ctrl-C; the result so far is kept
};

// The code for a failure, by the reason that its ErrorDetail carries.
ExitCode ExitCodeFor(const absl::Status& status);

// Prints `error: WHERE: WHAT; DO THIS` as one line on standard error and, with `json`,
// {"error":{"reason","where","message","hint"}} on standard output. Returns ExitCodeFor(status).
ExitCode ReportError(const absl::Status& status, bool json);

// A mistake on the command line, in the environment or in lambert.toml: reason USAGE.
absl::Status UsageError(const std::string& where, const std::string& message,
                        const std::string& hint);

}  // namespace lambert::app

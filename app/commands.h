// The commands, one function each. Results go to standard output, everything else to standard
// error. An error is returned, not printed.
#pragma once

#include "absl/status/statusor.h"
#include "app/exit.h"
#include "app/interrupt.h"
#include "app/options.h"

namespace lambert::app {

absl::StatusOr<ExitCode> RunBake(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunPlan(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunSubmit(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunWatch(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunFetch(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunCancel(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunDelete(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunJobs(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunWorkers(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunCompare(const Options& options, Interrupt& interrupt);
absl::StatusOr<ExitCode> RunBench(const Options& options, Interrupt& interrupt);

}  // namespace lambert::app

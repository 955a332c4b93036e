// The `lambert` command.
#include <malloc.h>
#include <pthread.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/commands.h"
#include "app/exit.h"
#include "app/interrupt.h"
#include "radiosity/core/error.h"

namespace lambert::app {
namespace {

std::string ReadToml() {
  std::ifstream file("lambert.toml", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

absl::StatusOr<ExitCode> RunCommand(const Options& options, Interrupt& interrupt) {
  switch (options.command) {
    case Command::kBake:
      return RunBake(options, interrupt);
    case Command::kPlan:
      return RunPlan(options, interrupt);
    case Command::kSubmit:
      return RunSubmit(options, interrupt);
    case Command::kWatch:
      return RunWatch(options, interrupt);
    case Command::kFetch:
      return RunFetch(options, interrupt);
    case Command::kCancel:
      return RunCancel(options, interrupt);
    case Command::kDelete:
      return RunDelete(options, interrupt);
    case Command::kJobs:
      return RunJobs(options, interrupt);
    case Command::kWorkers:
      return RunWorkers(options, interrupt);
    case Command::kCompare:
      return RunCompare(options, interrupt);
    case Command::kBench:
      return RunBench(options, interrupt);
  }
  return ExitCode::kUsage;
}

// A result that did not reach its reader is a failure.
ExitCode FlushResults(ExitCode code) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return code;
  const absl::Status lost =
      MakeError(absl::StatusCode::kUnavailable,
                {"OUTPUT_FAILED", "standard output", "cannot be written", "check where it goes"});
  return code == ExitCode::kDone ? ReportError(lost, false) : code;
}

// Where addresses are limited (ulimit -v), threads take as few of them as will do: glibc sets aside
// 8 MiB for each one's stack and 64 MiB for its heap, whatever is used of them.
void SaveAddresses() {
  constexpr size_t kStackBytes = 1 << 20;
  rlimit limit;
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  mallopt(M_ARENA_MAX, 1);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
}

ExitCode Main(const std::vector<std::string>& arguments) {
  // Errors of the command line itself have to know this before it is understood.
  bool json = std::find(arguments.begin(), arguments.end(), "--json") != arguments.end();
  auto parsed = ParseCommandLine(arguments, ReadToml(),
                                 [](const std::string& name) { return std::getenv(name.c_str()); });
  if (!parsed.ok()) return ReportError(parsed.status(), json);
  if (!parsed->options) {
    std::fputs(parsed->text.c_str(), stdout);
    return FlushResults(ExitCode::kDone);
  }
  json = parsed->options->json;
  for (const std::string& warning : parsed->warnings) std::fprintf(stderr, "%s\n", warning.c_str());
  Interrupt interrupt;
  auto code = RunCommand(*parsed->options, interrupt);
  return FlushResults(code.ok() ? *code : ReportError(code.status(), json));
}

}  // namespace
}  // namespace lambert::app

int main(int argc, char** argv) {
  // A reader of our output that goes away is an error like any other, not a death.
  std::signal(SIGPIPE, SIG_IGN);
  lambert::app::SaveAddresses();
  try {
    return static_cast<int>(lambert::app::Main({argv + 1, argv + argc}));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: lambert: %s; use a smaller scene or a machine with more memory\n",
                 error.what());
    return static_cast<int>(lambert::app::ExitCode::kFailed);
  }
}

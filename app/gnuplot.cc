#include "app/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>

#include "absl/strings/str_replace.h"
#include "fmt/format.h"
#include "radiosity/core/error.h"

namespace lambert::app {
namespace {

constexpr std::array<const char*, 8> kColors = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                "#E69F00", "#56B4E9", "#000000", "#8C6D1F"};
constexpr std::array<int, 8> kPoints = {7, 5, 9, 13, 11, 15, 4, 6};  // filled ones first
constexpr size_t kMaxMessage = 400;                                  // of what gnuplot says

absl::Status GnuplotError(const std::string& script, const std::string& message) {
  return MakeError(absl::StatusCode::kUnavailable,
                   {"GNUPLOT_FAILED", script, message,
                    "install gnuplot-nox, and draw it in its folder with gnuplot NAME.gp"});
}

// Runs a program to its end; its exit status and what it said, or -1 where it cannot be started.
int RunQuietly(std::vector<std::string> arguments, const std::string& folder, std::string& said) {
  int pipe_ends[2];
  if (pipe2(pipe_ends, O_CLOEXEC) != 0) return -1;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  pid_t child = -1;
  const int failed = posix_spawnp(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(pipe_ends[1]);
  char buffer[1024];
  for (ssize_t got; failed == 0 && (got = read(pipe_ends[0], buffer, sizeof(buffer))) > 0;) {
    said.append(buffer, static_cast<size_t>(got));
  }
  close(pipe_ends[0]);
  if (failed != 0) return -1;
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

}  // namespace

std::string GnuplotQuoted(const std::string& text) {
  return "'" + absl::StrReplaceAll(text, {{"'", "''"}, {"\n", " "}}) + "'";
}

std::string GnuplotTerminal(const std::string& name, int width, int height) {
  return fmt::format(
      "# gnuplot {0}.gp makes {0}.png; gnuplot -e \"format='svg'\" {0}.gp makes {0}.svg.\n"
      "if (!exists('format')) format = 'png'\n"
      "if (format eq 'svg') set terminal svg size {1},{2} dynamic enhanced font 'sans-serif,13' "
      "background 'white'\n"
      "if (format eq 'png') set terminal pngcairo size {1},{2} enhanced font 'sans,10'\n"
      "set output '{0}.' . format\n",
      name, width, height);
}

std::string GnuplotLineTypes() {
  std::string text;
  for (size_t k = 0; k < 3 * kColors.size(); ++k) {
    text += fmt::format("set linetype {} lc rgb '{}' lw 1.6 dt {} pt {} ps 0.9\n", k + 1,
                        kColors[k % kColors.size()], 1 + k / kColors.size(),
                        kPoints[(k + k / kColors.size()) % kPoints.size()]);
  }
  return text;
}

int GnuplotTextWidth(const std::string& text) {
  constexpr int kCharacter = 7, kMargins = 110;
  return kCharacter * static_cast<int>(text.size()) + kMargins;
}

std::string GnuplotHeadline(const std::string& title, const std::string& facts, int left, int width,
                            int height) {
  constexpr double kTitle = 18, kFacts = 40;  // pixels from the top
  const double x = static_cast<double>(left) / width;
  return fmt::format(
      "set border 3 lc rgb '#444444'\nset tics nomirror\nset grid lc rgb '#e4e4e4' lt 1 lw 0.7\n"
      "set multiplot\n"
      "set label 1 {} at screen {:.5f},{:.5f} left noenhanced font ',12'\n"
      "set label 2 {} at screen {:.5f},{:.5f} left noenhanced tc rgb '#555555'\n",
      GnuplotQuoted(title), x, 1 - kTitle / height, GnuplotQuoted(facts), x, 1 - kFacts / height);
}

std::string GnuplotPlace(int left, int top, int plot_width, int plot_height, int width,
                         int height) {
  const double w = width, h = height;
  return fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
      "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n",
      left / w, (left + plot_width) / w, 1 - top / h, 1 - (top + plot_height) / h);
}

absl::Status RunGnuplot(const std::string& folder, const std::string& script,
                        const std::vector<std::string>& formats) {
  for (const std::string& format : formats) {
    std::string said;
    const int exit_status =
        RunQuietly({"gnuplot", "-e", "format='" + format + "'", script}, folder, said);
    if (exit_status < 0 || exit_status == 127) {
      return GnuplotError(script, "gnuplot cannot be started");
    }
    if (exit_status != 0) {
      return GnuplotError(script, "gnuplot failed: " + said.substr(0, kMaxMessage));
    }
  }
  return absl::OkStatus();
}

}  // namespace lambert::app

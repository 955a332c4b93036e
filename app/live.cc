#include "app/live.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <sstream>
#include <thread>
#include <vector>

namespace lambert::app {
namespace {

constexpr auto kPeriod = std::chrono::seconds(1);
constexpr auto kLookForCtrlC = std::chrono::milliseconds(50);

// Escape sequences of every terminal since the VT100: a second screen, and what is on it.
constexpr char kEnter[] = "\x1b[?1049h\x1b[?25l";
constexpr char kLeave[] = "\x1b[?25h\x1b[?1049l";
constexpr char kHome[] = "\x1b[H";
constexpr char kClearLine[] = "\x1b[K";
constexpr char kClearBelow[] = "\x1b[J";

// The columns of the first `columns` characters of a line.
std::string Cut(const std::string& line, int columns) {
  size_t end = 0;
  while (end < line.size() && columns > 0) {
    ++end;
    while (end < line.size() && (line[end] & 0xc0) == 0x80) ++end;
    --columns;
  }
  return line.substr(0, end);
}

class Screen {
 public:
  Screen() { std::fputs(kEnter, stdout); }
  ~Screen() {
    std::fputs(kLeave, stdout);
    std::fputs(last_.c_str(), stdout);
  }
  void Draw(const std::string& text) {
    last_ = text;
    winsize size{};
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_row == 0) size = {24, 80, 0, 0};
    std::istringstream lines(FitScreen(text, size.ws_row, size.ws_col));
    std::fputs(kHome, stdout);
    const char* separator = "";
    for (std::string line; std::getline(lines, line); separator = "\r\n") {
      std::fputs((separator + line + kClearLine).c_str(), stdout);
    }
    std::fputs(kClearBelow, stdout);
    std::fflush(stdout);
  }

 private:
  std::string last_;
};

// Waits for the next second. False after Ctrl-C.
bool WaitForTurn(const Interrupt& interrupt) {
  const auto until = std::chrono::steady_clock::now() + kPeriod;
  while (!interrupt.seen() && std::chrono::steady_clock::now() < until) {
    std::this_thread::sleep_for(kLookForCtrlC);
  }
  return !interrupt.seen();
}

absl::StatusOr<ExitCode> Follow(Interrupt& interrupt,
                                const std::function<void(const std::string&)>& show,
                                const std::function<absl::StatusOr<std::string>()>& draw) {
  do {
    absl::StatusOr<std::string> text = draw();
    if (!text.ok() && interrupt.seen()) break;  // Ctrl-C cut the call off
    if (!text.ok()) return text.status();
    show(*text);
  } while (WaitForTurn(interrupt));
  return ExitCode::kInterrupted;
}

}  // namespace

std::string FitScreen(const std::string& text, int rows, int columns) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(Cut(line, columns));
  if (static_cast<int>(lines.size()) > rows) {
    const size_t shown = static_cast<size_t>(rows) - 1;
    const std::string rest = "... and " + std::to_string(lines.size() - shown) + " more";
    lines.resize(shown);
    lines.push_back(Cut(rest, columns));
  }
  std::string fitted;
  for (const std::string& line : lines) fitted += line + "\n";
  return fitted;
}

absl::StatusOr<ExitCode> ShowTable(bool watch, Interrupt& interrupt,
                                   const std::function<absl::StatusOr<std::string>()>& draw) {
  if (!watch) {
    absl::StatusOr<std::string> text = draw();
    if (!text.ok()) return text.status();
    std::fputs(text->c_str(), stdout);
    return ExitCode::kDone;
  }
  if (isatty(STDOUT_FILENO)) {
    Screen screen;
    return Follow(
        interrupt, [&](const std::string& text) { screen.Draw(text); }, draw);
  }
  std::string last;
  return Follow(
      interrupt,
      [&](const std::string& text) {
        if (text == last) return;
        std::fputs(text.c_str(), stdout);
        std::fflush(stdout);
        last = text;
      },
      draw);
}

}  // namespace lambert::app

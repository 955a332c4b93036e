// What programs say while they run: a sentence, and what it is about.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

namespace lambert {

// What a line is about; "" and -1 where it does not apply.
struct LogSubject {
  std::string job = {};  // "solveJobs/ID"
  int64_t step = -1;
  int unit = -1;
  std::string worker = {};  // as it calls itself
};

struct LogLine {
  // Implicit: many lines are about the program itself.
  LogLine(const char* text) : text(text) {}         // NOLINT(google-explicit-constructor)
  LogLine(std::string text, LogSubject about = {})  // NOLINT(google-explicit-constructor)
      : text(std::move(text)), about(std::move(about)) {}

  std::string text;
  LogSubject about;
};

// May be called from any thread.
using Log = std::function<void(const LogLine&)>;

}  // namespace lambert

// A program's log on standard error, for people or for machines.
#pragma once

#include <string>

#include "radiosity/core/log.h"

namespace lambert {

enum class LogFormat {
  kText,  // [TIME] [PROGRAM] [info] TEXT job=... step=... unit=... worker=...
  kJson,  // one object a line: time, level, program, text, and job, step, unit, worker where they
          // apply
};

// What a line says after its time and program. Keys that do not apply are left out; bytes that are
// no UTF-8 are replaced.
std::string TextOf(const LogLine& line);
// The same as the members of a JSON object, without its braces.
std::string JsonMembersOf(const LogLine& line);

// The program's log, and spdlog's default. Call it once.
Log StartLog(const std::string& program, LogFormat format);

}  // namespace lambert

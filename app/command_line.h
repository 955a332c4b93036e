// The command line of `lambert`: flags over environment over lambert.toml over defaults.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "app/options.h"

namespace lambert::app {

struct ParsedLine {
  std::optional<Options> options;     // absent where only `text` was asked for
  std::string text;                   // help or version, for standard output
  std::vector<std::string> warnings;  // flags that were given and have no effect
};

// `arguments` without the program's name; `toml_text` is lambert.toml of the working folder, ""
// where there is none; `environment` returns a variable's value or nullptr. USAGE names the
// choices.
absl::StatusOr<ParsedLine> ParseCommandLine(
    const std::vector<std::string>& arguments, const std::string& toml_text,
    const std::function<const char*(const std::string&)>& environment);

}  // namespace lambert::app

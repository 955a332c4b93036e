// Where option values come from beside the command line: the environment and lambert.toml.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace lambert::app {

// Which source an option's value came from; a later one wins over an earlier one.
enum class Layer { kDefault, kFile, kEnvironment, kFlag };

// Values of one option as text: one, or several of an option that may be repeated.
struct Setting {
  Layer layer = Layer::kDefault;
  std::string where;  // "LAMBERT_SEED" or "lambert.toml, seed": used in messages
  std::vector<std::string> values;
};

// By option name without dashes in front: "max-error".
using Settings = std::map<std::string, Setting>;

// The variable of an option: "max-error" -> "LAMBERT_MAX_ERROR".
std::string EnvironmentName(const std::string& option);

// Values for `options` from lambert.toml (text of the file; "" where there is none) and, over them,
// from the environment (an empty variable counts as none). The file is flat: `max-error = 0.01`,
// `region = ["desk", "floor"]`. Fails with USAGE on a file that is not TOML, and on a key that is
// no option, naming the nearest one.
absl::StatusOr<Settings> ReadSettings(
    const std::vector<std::string>& options, const std::string& toml_text,
    const std::function<const char*(const std::string&)>& environment);

// The member of `choices` that is most like `word`, or "" where none is near.
std::string NearestWord(const std::string& word, const std::vector<std::string>& choices);

}  // namespace lambert::app

// The options of the shooting methods by name: the one list from which the command's flags, the
// bytes on the wire and the report are made.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "radiosity/shoot/options.h"

namespace lambert {

struct ShootSetting {
  const char* name;  // "phs-depth": the flag without its dashes
  const char*
      value_name;    // "N"; "a|b" lists the choices, "a|b,..." where any number of them may be
  const char* help;  // one line, ends with the default in parentheses
  std::string (*get)(const ShootOptions&);
  // False, and nothing changes, for text that is no value of this setting. Ranges are checked by
  // ShootOptions::Validate.
  bool (*set)(const std::string& text, ShootOptions& options);
};

// All but the method and the region.
const std::vector<ShootSetting>& ShootSettings();

// FIELD_INVALID naming the choices for an unknown name, or the field for a text that is no value.
absl::Status ApplySetting(const std::string& name, const std::string& text, ShootOptions& options);

// The settings that differ from the defaults, by name; ApplySetting of each restores the options.
std::map<std::string, std::string> ChangedSettings(const ShootOptions& options);

}  // namespace lambert

#include "app/settings.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "app/exit.h"
#include "fmt/format.h"
#include "toml++/toml.h"

namespace lambert::app {
namespace {

constexpr char kFileName[] = "lambert.toml";

absl::StatusOr<std::string> TextOf(const toml::node& node, const std::string& where) {
  if (auto text = node.value_exact<std::string>()) return *text;
  if (auto flag = node.value_exact<bool>()) return std::string(*flag ? "true" : "false");
  if (auto number = node.value_exact<int64_t>()) return fmt::format("{}", *number);
  if (auto number = node.value_exact<double>()) return fmt::format("{}", *number);
  return UsageError(where, "a value here is a text, a number, true or false",
                    "write it as on the command line, such as max-error = 0.01");
}

absl::StatusOr<std::vector<std::string>> ValuesOf(const toml::node& node,
                                                  const std::string& where) {
  std::vector<std::string> values;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) {
      auto text = TextOf(element, where);
      if (!text.ok()) return text.status();
      values.push_back(*text);
    }
    return values;
  }
  auto text = TextOf(node, where);
  if (!text.ok()) return text.status();
  values.push_back(*text);
  return values;
}

absl::Status ReadFile(const std::vector<std::string>& options, const std::string& toml_text,
                      Settings& settings) {
  toml::table table;
  try {
    table = toml::parse(toml_text);
  } catch (const toml::parse_error& error) {
    return UsageError(fmt::format("{}, line {}", kFileName, error.source().begin.line),
                      std::string(error.description()), "write it as key = value");
  }
  for (const auto& [key, node] : table) {
    std::string name(key.str());
    std::replace(name.begin(), name.end(), '_', '-');
    const std::string where = fmt::format("{}, {}", kFileName, name);
    if (std::find(options.begin(), options.end(), name) == options.end()) {
      const std::string nearest = NearestWord(name, options);
      return UsageError(where, "this is no option",
                        nearest.empty() ? "see lambert bake --help" : "did you mean " + nearest);
    }
    auto values = ValuesOf(node, where);
    if (!values.ok()) return values.status();
    settings[name] = {Layer::kFile, where, *values};
  }
  return absl::OkStatus();
}

int EditDistance(const std::string& a, const std::string& b) {
  std::vector<int> row(b.size() + 1);
  for (size_t j = 0; j < row.size(); ++j) row[j] = static_cast<int>(j);
  for (size_t i = 1; i <= a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i);
    for (size_t j = 1; j <= b.size(); ++j) {
      const int replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string EnvironmentName(const std::string& option) {
  std::string name = "LAMBERT_" + option;
  for (char& c : name) c = c == '-' ? '_' : static_cast<char>(std::toupper(c));
  return name;
}

absl::StatusOr<Settings> ReadSettings(
    const std::vector<std::string>& options, const std::string& toml_text,
    const std::function<const char*(const std::string&)>& environment) {
  Settings settings;
  if (absl::Status status = ReadFile(options, toml_text, settings); !status.ok()) return status;
  for (const std::string& option : options) {
    const std::string variable = EnvironmentName(option);
    const char* text = environment(variable);
    if (text != nullptr && *text != '\0') {
      settings[option] = {Layer::kEnvironment, variable, {text}};
    }
  }
  return settings;
}

std::string NearestWord(const std::string& word, const std::vector<std::string>& choices) {
  // Two slips, or a third of a long word: more is another word.
  int best = std::max<int>(2, static_cast<int>(word.size()) / 3) + 1;
  std::string nearest;
  for (const std::string& choice : choices) {
    const int distance = EditDistance(word, choice);
    if (distance < best) {
      best = distance;
      nearest = choice;
    }
  }
  return nearest;
}

}  // namespace lambert::app

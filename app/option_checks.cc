#include "app/option_checks.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "app/exit.h"
#include "fmt/format.h"

namespace lambert::app {
namespace {

bool ReadNumber(const std::string& text, double& value) {
  const char* end = text.data() + text.size();
  auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end && std::isfinite(value);
}

}  // namespace

CLI::Validator Check(std::function<std::string(std::string&)> check) {
  return CLI::Validator(std::move(check), "");
}

CLI::Validator NumberFrom(double low, double high) {
  return Check([low, high](std::string& text) -> std::string {
    double value = 0;
    if (ReadNumber(text, value) && value >= low && value <= high) return "";
    if (std::isinf(high)) return fmt::format("'{}' is not a number of at least {}", text, low);
    return fmt::format("'{}' is not a number from {} to {}", text, low, high);
  });
}

CLI::Validator CountFrom(int64_t low, int64_t high) {
  return Check([low, high](std::string& text) -> std::string {
    const std::string given = text;
    std::string digits = text;
    double scale = 1;
    if (!digits.empty()) {
      const char suffix = digits.back();
      scale = suffix == 'k' ? 1e3 : suffix == 'M' ? 1e6 : suffix == 'G' ? 1e9 : 1;
      if (scale > 1) digits.pop_back();
    }
    double value = 0;
    // 2^53: every whole number up to there is exact in a double.
    const bool is_count = ReadNumber(digits, value) && value * scale == std::floor(value * scale) &&
                          std::abs(value * scale) <= 9007199254740992.0;
    if (!is_count || value * scale < low || value * scale > high) {
      return fmt::format("'{}' is not a whole number from {} to {}", given, low, high);
    }
    text = fmt::format("{}", static_cast<int64_t>(value * scale));
    return "";
  });
}

CLI::Validator OneOf(const std::vector<std::string>& choices) {
  return Check([choices](std::string& text) -> std::string {
    if (std::find(choices.begin(), choices.end(), text) != choices.end()) return "";
    return fmt::format("'{}' is not one of {}", text, fmt::join(choices, ", "));
  });
}

// "--flag: what" is CLI11's form of a check that failed, "Could not convert: --flag = text" that of
// a number that is none.
absl::Status FromCliError(const CLI::ParseError& error, const std::string& command) {
  constexpr char kNoNumber[] = "Could not convert: ";
  const std::string text = error.what();
  const std::string hint = "see " + command + " --help";
  if (text.rfind(kNoNumber, 0) == 0) {
    const std::string rest = text.substr(sizeof(kNoNumber) - 1);
    const size_t equals = rest.find(" = ");
    if (equals != std::string::npos) {
      return UsageError(rest.substr(0, equals), "'" + rest.substr(equals + 3) + "' is no number",
                        hint);
    }
  }
  const size_t colon = text.find(": ");
  if (text.rfind("--", 0) == 0 && colon != std::string::npos) {
    return UsageError(text.substr(0, colon), text.substr(colon + 2), hint);
  }
  return UsageError(command, text, hint);
}

}  // namespace lambert::app

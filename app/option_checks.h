// What the value of an option may be, and the message where it is not. For the files that build the
// command line.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "CLI/CLI.hpp"
#include "absl/status/status.h"

namespace lambert::app {

// A check without a name of its own, so that --help shows only our words. `check` may change the
// text, and returns what is wrong with it or "".
CLI::Validator Check(std::function<std::string(std::string&)> check);

// A finite number from `low` to `high`.
CLI::Validator NumberFrom(double low, double high = std::numeric_limits<double>::infinity());

// Whole numbers; also as 1e7, and with k, M or G for thousands, millions, billions.
CLI::Validator CountFrom(int64_t low, int64_t high);
inline constexpr int64_t kAnyCount = 9007199254740992;  // 2^53

// One of a few words, which the message names.
CLI::Validator OneOf(const std::vector<std::string>& choices);

// What CLI11 did not like, as our USAGE error. `command`: "lambert bake", whose help is the hint.
absl::Status FromCliError(const CLI::ParseError& error, const std::string& command);

}  // namespace lambert::app

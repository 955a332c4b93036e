#include "app/bench_list.h"

#include <algorithm>
#include <set>
#include <utility>

#include "absl/strings/str_split.h"
#include "app/exit.h"
#include "app/option_checks.h"
#include "app/option_groups.h"
#include "app/progress_text.h"
#include "fmt/format.h"
#include "radiosity/core/error.h"

namespace lambert::app {
namespace {

// Shares of the largest budget at which errors are measured.
constexpr double kSteps[] = {0.04, 0.1, 0.2, 0.5, 1};

// Options of a method begin with its name, or with the letters that the names of its family begin
// with: "phs-alpha" has those of "phs", "hs98" those of "hs".
std::vector<std::string> Prefixes(const std::string& method) {
  const auto end = std::find_if(method.begin(), method.end(), [](char c) { return c < 'a'; });
  return {method + "-", std::string(method.begin(), end) + "-"};
}

std::vector<std::string> KeysOf(const std::string& method, const CLI::App& parser) {
  std::vector<std::string> keys;
  for (const CLI::Option* option : parser.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      for (const std::string& prefix : Prefixes(method)) {
        if (name.rfind(prefix, 0) != 0) continue;
        keys.push_back(name.substr(prefix.size()));
        break;
      }
    }
  }
  return keys;
}

// The option that a key stands for, without dashes; "" where there is none.
std::string OptionOf(const std::string& method, const std::string& key, const CLI::App& parser) {
  for (const std::string& prefix : Prefixes(method)) {
    const std::string name = prefix + key;
    if (parser.get_option_no_throw("--" + name) != nullptr) return name;
  }
  return "";
}

absl::Status UnknownKey(const std::string& entry, const std::string& method, const std::string& key,
                        const CLI::App& parser) {
  const std::vector<std::string> keys = KeysOf(method, parser);
  return UsageError(
      "--methods " + entry, fmt::format("the method {} has no setting '{}'", method, key),
      keys.empty() ? "it has none" : fmt::format("choose one of {}", fmt::join(keys, ", ")));
}

// The message of `status` told about an entry.
absl::Status AboutEntry(const std::string& entry, const absl::Status& status) {
  const auto detail = GetErrorDetail(status);
  if (!detail) return status;
  return UsageError("--methods " + entry, detail->message, detail->hint);
}

absl::StatusOr<BenchEntry> ParseEntry(const std::string& written, const SolveOptions& base) {
  const std::vector<std::string> parts = absl::StrSplit(written, ':');
  const std::string& method = parts.front();
  if (auto known = ParseMethod(method); !known.ok()) {
    return AboutEntry(written, known.status());
  }
  Draft draft;
  draft.options.solve = base;
  CLI::App parser;
  AddMethodOptions(parser, draft);
  std::vector<std::string> arguments = {"--method=" + method};
  for (size_t k = 1; k < parts.size(); ++k) {
    const std::string key = parts[k].substr(0, parts[k].find('='));
    const std::string option = OptionOf(method, key, parser);
    if (option.empty()) return UnknownKey(written, method, key, parser);
    arguments.push_back("--" + option + parts[k].substr(key.size()));
  }
  std::reverse(arguments.begin(), arguments.end());  // the order that CLI11 takes a vector in
  try {
    parser.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    return AboutEntry(written, FromCliError(error, "lambert bench"));
  }
  const SolveOptions& solve = draft.options.solve;
  if (absl::Status status = solve.Validate(); !status.ok()) return AboutEntry(written, status);
  return BenchEntry{written, solve, true};
}

}  // namespace

absl::StatusOr<std::vector<BenchEntry>> ParseBenchEntries(const std::vector<std::string>& written,
                                                          const SolveOptions& base) {
  std::vector<BenchEntry> entries;
  std::set<std::string> seen;
  for (const std::string& entry : written.empty() ? std::vector<std::string>{"all"} : written) {
    if (entry == "all") {
      for (Method method : AllMethods()) {
        if (!seen.insert(MethodName(method)).second) continue;
        SolveOptions solve = base;
        solve.shoot.method = method;
        entries.push_back({MethodName(method), solve, false});
      }
      continue;
    }
    auto parsed = ParseEntry(entry, base);
    if (!parsed.ok()) return parsed.status();
    if (!seen.insert(entry).second) {
      return UsageError("--methods", fmt::format("'{}' stands there twice", entry),
                        "give every method, or every setting of it, once");
    }
    entries.push_back(*std::move(parsed));
  }
  return entries;
}

absl::StatusOr<BenchBudget> ParseBenchBudget(const std::string& text) {
  const bool is_time = !text.empty() && text.back() == 's';
  std::string number = is_time ? text.substr(0, text.size() - 1) : text;
  const CLI::Validator check = is_time ? NumberFrom(1e-3) : CountFrom(1, kAnyCount);
  if (!check(number).empty()) {
    return UsageError("--budgets", fmt::format("'{}' is neither rays nor seconds", text),
                      "write rays as 200k or 2e5, seconds as 1.5s");
  }
  if (is_time) return BenchBudget{0, std::stod(number)};
  return BenchBudget{std::stoll(number), 0};
}

std::string BudgetText(const BenchBudget& budget) {
  return budget.rays > 0 ? fmt::format("{}", budget.rays) : fmt::format("{}s", budget.seconds);
}

std::string BudgetForPeople(const BenchBudget& budget) {
  return budget.rays > 0 ? FormatCount(static_cast<double>(budget.rays), "rays")
                         : FormatDuration(budget.seconds);
}

std::vector<BenchBudget> BenchBudgets(const Options& options) {
  if (!options.bench.budgets.empty()) return options.bench.budgets;
  const double seconds = options.solve.max_time_s;
  int64_t rays = options.solve.max_rays;
  if (rays == 0 && seconds == 0) rays = kDefaultBenchRays;
  std::vector<BenchBudget> budgets;
  for (double step : kSteps) {
    const auto part = static_cast<int64_t>(step * static_cast<double>(rays));
    if (part > 0) budgets.push_back({part, 0});
  }
  for (double step : kSteps) {
    if (seconds > 0) budgets.push_back({0, step * seconds});
  }
  return budgets;
}

SolveOptions WithBudget(SolveOptions solve, const BenchBudget& budget, uint64_t seed) {
  solve.max_error = 0;
  solve.max_rays = budget.rays;
  solve.max_time_s = budget.seconds;
  solve.seed = seed;
  return solve;
}

}  // namespace lambert::app

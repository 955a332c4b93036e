#include "app/bench_list.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "absl/strings/str_split.h"
#include "app/exit.h"
#include "app/option_checks.h"
#include "app/progress_text.h"
#include "fmt/format.h"
#include "radiosity/core/error.h"
#include "radiosity/shoot/settings.h"

namespace lambert::app {
namespace {

// Shares of the largest budget at which errors are measured.
constexpr double kSteps[] = {0.04, 0.1, 0.2, 0.5, 1};

// The settings that a method has, by key: their names without "phs-".
std::map<std::string, std::string> KeysOf(Method method) {
  const std::string family = "phs-";
  std::map<std::string, std::string> keys;
  for (const ShootSetting& setting : ShootSettings()) {
    const std::string name = setting.name;
    const bool of_pyramids = name.starts_with(family);
    if (of_pyramids && !UsesPyramids(method)) continue;
    keys[of_pyramids ? name.substr(family.size()) : name] = name;
  }
  return keys;
}

std::string Choices(const std::map<std::string, std::string>& keys) {
  std::vector<std::string> names;
  for (const auto& [key, name] : keys) names.push_back(key);
  return fmt::format("choose one of {}", fmt::join(names, ", "));
}

// The message of `status` told about an entry.
absl::Status AboutEntry(const std::string& entry, const absl::Status& status) {
  const auto detail = GetErrorDetail(status);
  if (!detail) return status;
  return UsageError("--methods " + entry, detail->message, detail->hint);
}

absl::StatusOr<BenchEntry> ParseEntry(const std::string& written, const SolveOptions& base) {
  const std::vector<std::string> parts = absl::StrSplit(written, ':');
  auto method = ParseMethod(parts.front());
  if (!method.ok()) return AboutEntry(written, method.status());
  SolveOptions solve = base;
  solve.shoot.method = *method;
  const std::map<std::string, std::string> keys = KeysOf(*method);
  for (size_t k = 1; k < parts.size(); ++k) {
    const std::vector<std::string> pair = absl::StrSplit(parts[k], absl::MaxSplits('=', 1));
    const auto key = keys.find(pair.front());
    if (key == keys.end()) {
      return UsageError("--methods " + written,
                        fmt::format("the method {} has no setting '{}'", parts[0], pair[0]),
                        Choices(keys));
    }
    absl::Status set = ApplySetting(key->second, pair.size() > 1 ? pair[1] : "", solve.shoot);
    if (!set.ok()) return AboutEntry(written, set);
  }
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

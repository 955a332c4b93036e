// What a bench runs, as the user writes it: methods with their settings, and budgets.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "app/options.h"
#include "radiosity/solve/options.h"

namespace lambert::app {

// A method with its settings.
struct BenchEntry {
  std::string label;    // as written: "phs:depth=3:sampling=solid-angle"
  SolveOptions solve;   // without budget and seed
  bool by_name = true;  // false: it came with "all", and is left out where it cannot run
};

// METHOD[:KEY=VALUE]..., for each of `written`; "all", or nothing written, is every method of the
// library. KEY stands for the option --METHOD-KEY, or for --phs-KEY with phs and all that begin
// with it, and `base` holds what such options say on the bench's own line. USAGE names the choices
// for an unknown method or key, and says which entry stands twice.
absl::StatusOr<std::vector<BenchEntry>> ParseBenchEntries(const std::vector<std::string>& written,
                                                          const SolveOptions& base);

// "200k", "2e5": rays; "1.5s": seconds. USAGE for anything else.
absl::StatusOr<BenchBudget> ParseBenchBudget(const std::string& text);
// "200000" or "1.5s".
std::string BudgetText(const BenchBudget& budget);
// "200 krays" or "1.5 s".
std::string BudgetForPeople(const BenchBudget& budget);

// What was asked for: --budgets; else steps up to --max-rays and --max-time; else steps up to
// kDefaultBenchRays.
std::vector<BenchBudget> BenchBudgets(const Options& options);
inline constexpr int64_t kDefaultBenchRays = 5'000'000;

// `solve` with that budget and seed.
SolveOptions WithBudget(SolveOptions solve, const BenchBudget& budget, uint64_t seed);

}  // namespace lambert::app

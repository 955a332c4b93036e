// convergence.csv: error against rays and time, one line a step, appended as the run goes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/output/compare.h"
#include "radiosity/solve/solution.h"

namespace lambert {

struct ConvergenceRow {
  std::string method;  // MethodName
  uint64_t seed = 0;
  Progress progress;
  ErrorMeasures measures;  // empty without a reference
};

// The first line of the file, and one row of it, both with their line end. Values that are not
// known are left empty.
std::string ConvergenceHeader();
std::string FormatConvergenceRow(const ConvergenceRow& row);

// An open convergence.csv; every appended row is in the file when Append returns. One thread.
class ConvergenceLog {
 public:
  // Starts the file anew.
  static absl::StatusOr<ConvergenceLog> Create(const std::string& path);
  ConvergenceLog(ConvergenceLog&& other) noexcept;
  ConvergenceLog& operator=(ConvergenceLog&&) = delete;
  ~ConvergenceLog();

  absl::Status Append(const ConvergenceRow& row);

 private:
  ConvergenceLog(std::string path, int descriptor)
      : path_(std::move(path)), descriptor_(descriptor) {}
  std::string path_;
  int descriptor_ = -1;  // -1: moved from
};

}  // namespace lambert

#include "radiosity/output/convergence.h"

#include <fcntl.h>
#include <unistd.h>

#include "radiosity/output/number_text.h"
#include "radiosity/output/output_file.h"

namespace lambert {
namespace {

void AppendMeasure(std::optional<double> value, std::string& text) {
  text.push_back(',');
  if (value.has_value()) AppendNumber(*value, text);
}

std::optional<double> KnownEstimate(double estimate) {
  if (estimate < 0) return std::nullopt;
  return estimate;
}

}  // namespace

std::string ConvergenceHeader() {
  return "method,seed,pass,step,rays,seconds,cpu_seconds,unsent_fraction,estimated_rms_area,"
         "estimated_rms_patch,rms_area,rms_patch,rms_local,p95,power_bias\n";
}

std::string FormatConvergenceRow(const ConvergenceRow& row) {
  const Progress& progress = row.progress;
  std::string text = row.method + ",";
  AppendNumber(row.seed, text);
  for (int64_t count : {int64_t{progress.pass}, int64_t{progress.step}, progress.rays}) {
    text.push_back(',');
    AppendNumber(count, text);
  }
  for (double value : {progress.seconds, progress.cpu_seconds, progress.unsent_fraction}) {
    AppendMeasure(value, text);
  }
  AppendMeasure(KnownEstimate(progress.estimated_rms_area), text);
  AppendMeasure(KnownEstimate(progress.estimated_rms_patch), text);
  const ErrorMeasures& measures = row.measures;
  for (std::optional<double> measure : {measures.rms_area, measures.rms_patch, measures.rms_local,
                                        measures.p95, measures.power_bias}) {
    AppendMeasure(measure, text);
  }
  text.push_back('\n');
  return text;
}

absl::StatusOr<ConvergenceLog> ConvergenceLog::Create(const std::string& path) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor < 0) return OutputError(path);
  ConvergenceLog log(path, descriptor);
  if (absl::Status status = WriteAll(descriptor, path, ConvergenceHeader()); !status.ok()) {
    return status;
  }
  return log;
}

ConvergenceLog::ConvergenceLog(ConvergenceLog&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(other.descriptor_) {
  other.descriptor_ = -1;
}

ConvergenceLog::~ConvergenceLog() {
  if (descriptor_ >= 0) close(descriptor_);
}

absl::Status ConvergenceLog::Append(const ConvergenceRow& row) {
  return WriteAll(descriptor_, path_, FormatConvergenceRow(row));
}

}  // namespace lambert

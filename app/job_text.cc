#include "app/job_text.h"

#include "app/progress_text.h"
#include "app/result.h"
#include "fmt/format.h"

namespace lambert::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kColumns[] = "{:<40} {:<10} {:<18} {:>12} {:>13}  {}";

}  // namespace

Json JobJson(const client::Job& job) {
  const Progress& progress = job.progress;
  Json json = {
      {"job", job.name},
      {"scene", job.scene_name},
      {"state", client::JobStateName(job.state)},
      {"stop_reason", StopReasonName(job.stop_reason)},
      {"reached_goal", job.reached_goal},
      {"snapshot", job.snapshot_version},
      {"pass", progress.pass},
      {"rays", progress.rays},
      {"seconds", progress.seconds},
      {"cpu_seconds", progress.cpu_seconds},
      {"estimated_rms_area",
       progress.estimated_rms_area < 0 ? Json(nullptr) : Json(progress.estimated_rms_area)},
      {"wanted_rms_area", progress.wanted_rms_area}};
  if (!job.error.ok()) json["error"] = std::string(job.error.message());
  return json;
}

std::string JobLine(const client::Job& job) {
  const Progress& progress = job.progress;
  std::string error =
      progress.estimated_rms_area < 0 ? "-" : FormatPercent(progress.estimated_rms_area);
  if (progress.wanted_rms_area > 0) error += " -> " + FormatPercent(progress.wanted_rms_area);
  return fmt::format(kColumns, job.name, client::JobStateName(job.state), error,
                     FormatCount(static_cast<double>(progress.rays), "rays"),
                     FormatDuration(progress.seconds), job.scene_name);
}

std::string JobHead() {
  return fmt::format(kColumns, "JOB", "STATE", "ERROR", "SHOT", "TIME", "SCENE");
}

std::string JsonText(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace lambert::app

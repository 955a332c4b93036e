#include "app/result.h"

#include <cstdio>
#include <filesystem>
#include <utility>

#include "app/measures_text.h"
#include "app/progress.h"
#include "app/progress_text.h"
#include "app/scene_files.h"
#include "fmt/format.h"
#include "nlohmann/json.hpp"
#include "radiosity/gather/gather_points.h"
#include "radiosity/output/output_file.h"
#include "radiosity/output/write_outputs.h"

namespace lambert::app {
namespace {

std::vector<std::string> ResultFiles(const RunRecord& record, const std::string& folder) {
  std::vector<std::string> files;
  for (const std::string& name :
       {std::string("report.html"), record.name + ".png", record.name + ".glb",
        record.name + ".exr", record.name + ".lightmapped.glb", record.name + ".lit.glb",
        record.name + ".irradiance.exr", record.name + ".lightmap.json", std::string("patches.csv"),
        std::string("sensors.csv"), std::string("sensors.json"), std::string("convergence.csv"),
        std::string("run.json")}) {
    const auto path = std::filesystem::path(folder) / name;
    std::error_code error;
    if (std::filesystem::exists(path, error)) files.push_back(path.string());
  }
  return files;
}

std::string Verdict(const client::Job& job, const RunRecord& record) {
  const Progress& progress = record.snapshot.progress;
  const std::string wanted = FormatPercent(progress.wanted_rms_area);
  if (record.interrupted) return "interrupted: the best so far is kept";
  if (job.state == client::JobState::kFailed) return "failed: the last good result is kept";
  if (job.stop_reason == StopReason::kNothingToShoot) return "done: nothing emits, all is dark";
  if (job.state == client::JobState::kRunning) return "still running: the best so far";
  if (!job.reached_goal) return "stopped: the budget is spent before the wanted " + wanted;
  return job.stop_reason == StopReason::kErrorReached ? "done: the wanted error is reached"
                                                      : "done: the budget is spent";
}

nlohmann::ordered_json SummaryJson(const client::Job& job, const RunRecord& record,
                                   const std::vector<std::string>& files) {
  const Progress& progress = record.snapshot.progress;
  nlohmann::ordered_json warnings = nlohmann::ordered_json::array();
  for (const Warning& warning : job.warnings) {
    warnings.push_back({{"reason", warning.reason}, {"message", warning.message}});
  }
  nlohmann::ordered_json summary = {
      {"job", job.name},
      {"state", client::JobStateName(job.state)},
      {"stop_reason", StopReasonName(job.stop_reason)},
      {"reached_goal", job.reached_goal},
      {"interrupted", record.interrupted},
      {"method", MethodName(record.plan.options.shoot.method)},
      {"patches", record.patches->size()},
      {"snapshot", record.snapshot.version},
      {"pass", progress.pass},
      {"rays", progress.rays},
      {"seconds", progress.seconds},
      {"cpu_seconds", progress.cpu_seconds},
      {"estimated_rms_area", progress.estimated_rms_area < 0
                                 ? nlohmann::ordered_json(nullptr)
                                 : nlohmann::ordered_json(progress.estimated_rms_area)},
      {"wanted_rms_area", progress.wanted_rms_area},
      {"warnings", warnings},
      {"files", files}};
  if (record.measures) summary["measures"] = MeasuresJson(*record.measures);
  return summary;
}

// Gathers from the job's newest snapshot, `rays` a point. rays == 0: a function that is null.
GatherFunction MakeGather(client::Client& client, const client::Job& job, int rays, uint64_t seed,
                          std::function<void(const std::string&)> say) {
  if (rays == 0) return nullptr;
  return [&client, name = job.name, options = GatherOptions{rays, seed},
          say = std::move(say)](const GatherPoints& points) {
    say(fmt::format("gathering at {} points", points.size()));
    double said_at_s = MonotonicSeconds();
    return client.Gather(name, points, options, [&](size_t done, size_t total) {
      if (MonotonicSeconds() - said_at_s < 1) return;
      said_at_s = MonotonicSeconds();
      say(fmt::format("gathered at {} of {} points", done, total));
    });
  };
}

}  // namespace

absl::Status TestOutputFolder(const std::string& folder) {
  if (absl::Status status = MakeOutputFolder(folder); !status.ok()) return status;
  // Never committed, so it is gone when it goes out of scope.
  auto probe = OutputFile::Create((std::filesystem::path(folder) / "run.json").string());
  return probe.status();
}

absl::StatusOr<RunRecord> CollectRecord(client::Client& client, const client::Job& job,
                                        std::shared_ptr<const PatchSet> patches) {
  if (patches == nullptr) {
    auto fetched = client.FetchPatches(job.patch_set);
    if (!fetched.ok()) return fetched.status();
    patches = *std::move(fetched);
  }
  auto solution = client.FetchSolution(job.snapshot);
  if (!solution.ok()) return solution.status();
  RunRecord record;
  record.name = SceneStem(job.scene_name);
  record.scene_digest = job.scene.substr(job.scene.find('/') + 1);
  record.patches = std::move(patches);
  record.patch_options = job.patch_options;
  record.meshing = job.meshing;
  record.plan = job.plan;
  record.snapshot = {job.snapshot_version, job.snapshot_progress, *std::move(solution)};
  record.stop_reason = job.stop_reason;
  record.interrupted = job.state == client::JobState::kCancelled;
  record.versions = {{"lambert", LAMBERT_VERSION}};
  record.unit_version = job.unit_version;
  return record;
}

absl::StatusOr<std::vector<SensorGrid>> ReadOptionalSensors(const Options& options) {
  if (options.sensors_path.empty()) return std::vector<SensorGrid>();
  return ReadSensors(options.sensors_path);
}

absl::Status GatherAndWrite(client::Client& client, const client::Job& job, const Options& options,
                            std::vector<SensorGrid> sensors,
                            const std::function<void(const std::string&)>& say, RunRecord& record) {
  record.picture_options = options.picture;
  const uint64_t seed = record.plan.options.seed;
  if (options.work_plane_m > 0) {
    auto planes = WorkPlanes(*record.patches, options.work_plane_m);
    if (!planes.ok()) return planes.status();
    sensors.insert(sensors.end(), planes->begin(), planes->end());
  }
  if (!sensors.empty()) {
    const GatherFunction gather = MakeGather(client, job, kSensorRays, seed, say);
    absl::Status gathered = GatherSensors(*record.patches, gather, sensors);
    if (!gathered.ok()) return gathered;
    record.sensors = std::move(sensors);
  }
  const bool draws = options.outputs.NeedPicture() || options.lightmap;
  record.final_gather_rays = draws ? options.final_gather_rays : 0;
  return WriteOutputs(options.out_folder, record, options.outputs,
                      MakeGather(client, job, record.final_gather_rays, seed, say));
}

absl::StatusOr<ExitCode> ExitCodeOf(const client::Job& job) {
  if (job.state == client::JobState::kFailed) return job.error;
  if (job.state == client::JobState::kCancelled) return ExitCode::kInterrupted;
  const bool missed = job.solve_options.max_error > 0 && !job.reached_goal &&
                      job.stop_reason != StopReason::kNothingToShoot;
  return missed ? ExitCode::kBudgetSpent : ExitCode::kDone;
}

ConvergenceRow MakeConvergenceRow(const Plan& plan, const Progress& progress) {
  return {MethodName(plan.options.shoot.method), plan.options.seed, progress, {}};
}

void PrintSummary(const client::Job& job, const RunRecord& record, const std::string& folder,
                  bool json) {
  const std::vector<std::string> files = ResultFiles(record, folder);
  if (json) {
    const auto replace = nlohmann::json::error_handler_t::replace;
    std::printf("%s\n", SummaryJson(job, record, files).dump(2, ' ', false, replace).c_str());
    return;
  }
  const Progress& progress = record.snapshot.progress;
  std::string facts = progress.estimated_rms_area < 0
                          ? "error not known yet"
                          : "estimated error " + FormatPercent(progress.estimated_rms_area);
  facts += fmt::format(", {} in {}, {} patches, method {}", FormatCount(progress.rays, "rays"),
                       FormatDuration(progress.seconds), record.patches->size(),
                       MethodName(record.plan.options.shoot.method));
  std::printf("%s\n%s\n", Verdict(job, record).c_str(), facts.c_str());
  if (record.measures) std::fputs(MeasuresText(*record.measures).c_str(), stdout);
  for (const std::string& file : files) std::printf("  %s\n", file.c_str());
}

}  // namespace lambert::app

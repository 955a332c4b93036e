// Jobs that live on a server: submit, watch, fetch, cancel, delete, jobs, workers.
#include <cstdio>
#include <functional>
#include <memory>
#include <utility>

#include "app/commands.h"
#include "app/idle_notice.h"
#include "app/measure.h"
#include "app/progress.h"
#include "app/progress_text.h"
#include "app/result.h"
#include "app/scene_files.h"
#include "app/service.h"
#include "fmt/format.h"
#include "nlohmann/json.hpp"
#include "radiosity/core/error.h"
#include "radiosity/output/write_outputs.h"

namespace lambert::app {
namespace {

using Json = nlohmann::ordered_json;

void PrintJson(const Json& json) {
  std::printf("%s\n", json.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
}

// A client whose calls the first Ctrl-C ends; the jobs on the server go on.
class Connection {
 public:
  static absl::StatusOr<std::unique_ptr<Connection>> Open(
      const Options& options, Interrupt& interrupt,
      std::function<void(const std::string&)> on_notice = [](const std::string& notice) {
        std::fprintf(stderr, "%s\n", notice.c_str());
      }) {
    auto service = OpenService(options, std::move(on_notice));
    if (!service.ok()) return service.status();
    return std::unique_ptr<Connection>(new Connection(*std::move(service), interrupt));
  }
  ~Connection() { interrupt_.OnFirst(nullptr); }
  client::Client& client() { return *service_.client; }

 private:
  Connection(Service service, Interrupt& interrupt)
      : service_(std::move(service)), interrupt_(interrupt) {
    interrupt_.OnFirst([this] { service_.client->Abort(); });
  }
  Service service_;
  Interrupt& interrupt_;
};

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
  return fmt::format("{:<40} {:<10} {:<18} {:>12} {:>13}  {}", job.name,
                     client::JobStateName(job.state), error,
                     FormatCount(static_cast<double>(progress.rays), "rays"),
                     FormatDuration(progress.seconds), job.scene_name);
}

ExitCode PrintJob(const client::Job& job, const Options& options) {
  if (options.json) {
    PrintJson(JobJson(job));
  } else {
    std::printf("%s\n", JobLine(job).c_str());
  }
  return ExitCode::kDone;
}

// A job that runs replaces its newest solution now and then, also while it is being fetched.
absl::StatusOr<RunRecord> CollectLatest(client::Client& client, const std::string& name,
                                        client::Job& job) {
  constexpr int kAttempts = 5;
  for (int attempt = 1;; ++attempt) {
    auto found = client.GetJob(name);
    if (!found.ok()) return found.status();
    job = *std::move(found);
    if (job.snapshot_version == 0) {
      return MakeError(absl::StatusCode::kFailedPrecondition,
                       {"NO_SNAPSHOT", name, "there is no result yet", "fetch again later"});
    }
    auto record = CollectRecord(client, job, nullptr);
    if (record.ok() || !absl::IsNotFound(record.status()) || attempt == kAttempts) return record;
  }
}

}  // namespace

absl::StatusOr<ExitCode> RunSubmit(const Options& options, Interrupt& interrupt) {
  auto bundle = ReadSceneBundle(options.scene_path);
  if (!bundle.ok()) return bundle.status();
  auto connection = Connection::Open(options, interrupt);
  if (!connection.ok()) return connection.status();
  client::Client& client = (*connection)->client();
  auto scene = client.SubmitScene(*bundle, [](int64_t, int64_t) {});
  if (!scene.ok()) return scene.status();
  for (const Warning& warning : scene->warnings) {
    std::fprintf(stderr, "warning: %s\n", warning.message.c_str());
  }
  auto job = client.CreateJob(scene->name, options.patch, options.solve);
  if (!job.ok()) return job.status();
  if (options.json) return PrintJob(*job, options);
  std::printf("%s\n", job->name.c_str());
  return ExitCode::kDone;
}

absl::StatusOr<ExitCode> RunWatch(const Options& options, Interrupt& interrupt) {
  ProgressPrinter printer(ResolveProgressMode(options.progress, stderr), stderr, MonotonicSeconds);
  auto connection = Connection::Open(options, interrupt,
                                     [&printer](const std::string& line) { printer.Note(line); });
  if (!connection.ok()) return connection.status();
  auto job = (*connection)->client().GetJob(options.job);
  if (!job.ok()) return job.status();
  printer.SetTimeBudget(job->solve_options.max_time_s);
  client::WatchOptions watch;
  IdleNotice idle(&(*connection)->client(), &printer, options.server);
  watch.on_progress = [&](const Progress& progress) {
    printer.Update(progress);
    idle.Check(progress);
  };
  watch.on_snapshot = [&](const Snapshot& snapshot) {
    printer.Update(snapshot.progress);
    return absl::OkStatus();
  };
  auto ended = (*connection)->client().Watch(options.job, watch);
  printer.Finish();
  if (!ended.ok() && interrupt.seen()) {
    std::fprintf(stderr, "%s goes on; lambert cancel stops it\n", options.job.c_str());
    return ExitCode::kInterrupted;
  }
  if (!ended.ok()) return ended.status();
  PrintJob(*ended, options);
  return ExitCodeOf(*ended);
}

absl::StatusOr<ExitCode> RunFetch(const Options& options, Interrupt& interrupt) {
  if (absl::Status status = TestOutputFolder(options.out_folder); !status.ok()) return status;
  auto measurer = Measurer::Create(options.reference_path, options.regions);
  if (!measurer.ok()) return measurer.status();
  auto connection = Connection::Open(options, interrupt);
  if (!connection.ok()) return connection.status();
  client::Client& client = (*connection)->client();
  client::Job job;
  auto record = CollectLatest(client, options.job, job);
  if (!record.ok()) return record.status();
  auto snapshots = client.ListSnapshots(job.name);
  if (!snapshots.ok()) return snapshots.status();
  for (const Snapshot& snapshot : *snapshots) {
    if (snapshot.version > job.snapshot_version) break;
    record->convergence.push_back(MakeConvergenceRow(job.plan, snapshot.progress));
  }
  if (measurer->wanted()) {
    auto measures = measurer->Measure(*record->patches, *record->snapshot.solution);
    if (!measures.ok()) return measures.status();
    record->measures = *measures;
    if (!record->convergence.empty()) record->convergence.back().measures = *measures;
  }
  auto log = ConvergenceLog::Create(options.out_folder + "/convergence.csv");
  if (!log.ok()) return log.status();
  for (const ConvergenceRow& row : record->convergence) {
    if (absl::Status status = log->Append(row); !status.ok()) return status;
  }
  if (absl::Status status = WriteOutputs(options.out_folder, *record, options.outputs);
      !status.ok()) {
    return status;
  }
  PrintSummary(job, *record, options.out_folder, options.json);
  return ExitCode::kDone;
}

absl::StatusOr<ExitCode> RunCancel(const Options& options, Interrupt& interrupt) {
  auto connection = Connection::Open(options, interrupt);
  if (!connection.ok()) return connection.status();
  auto job = (*connection)->client().CancelJob(options.job);
  if (!job.ok()) return job.status();
  return PrintJob(*job, options);
}

absl::StatusOr<ExitCode> RunDelete(const Options& options, Interrupt& interrupt) {
  auto connection = Connection::Open(options, interrupt);
  if (!connection.ok()) return connection.status();
  absl::Status status = (*connection)->client().DeleteJob(options.job);
  if (!status.ok()) return status;
  if (options.json) PrintJson({{"deleted", options.job}});
  return ExitCode::kDone;
}

absl::StatusOr<ExitCode> RunJobs(const Options& options, Interrupt& interrupt) {
  auto connection = Connection::Open(options, interrupt);
  if (!connection.ok()) return connection.status();
  auto jobs = (*connection)->client().ListJobs();
  if (!jobs.ok()) return jobs.status();
  Json list = Json::array();
  for (const client::Job& job : *jobs) {
    if (options.json) {
      list.push_back(JobJson(job));
    } else {
      PrintJob(job, options);
    }
  }
  if (options.json) PrintJson(list);
  return ExitCode::kDone;
}

absl::StatusOr<ExitCode> RunWorkers(const Options& options, Interrupt& interrupt) {
  auto connection = Connection::Open(options, interrupt);
  if (!connection.ok()) return connection.status();
  auto workers = (*connection)->client().ListWorkers();
  if (!workers.ok()) return workers.status();
  Json list = Json::array();
  for (const client::Worker& worker : *workers) {
    if (options.json) {
      list.push_back({{"worker", worker.name},
                      {"slots", worker.slots},
                      {"leases", worker.leases},
                      {"finished_units", worker.finished_units},
                      {"silence_s", worker.silence_s}});
      continue;
    }
    std::printf("%-40s %3d slots %5d units held %9lld done  heard of %s ago\n", worker.name.c_str(),
                worker.slots, worker.leases, static_cast<long long>(worker.finished_units),
                FormatDuration(worker.silence_s).c_str());
  }
  if (options.json) PrintJson(list);
  return ExitCode::kDone;
}

}  // namespace lambert::app

// Jobs that live on a server: submit, watch, fetch, cancel, delete.
#include <cstdio>
#include <string>
#include <utility>

#include "app/commands.h"
#include "app/connection.h"
#include "app/idle_notice.h"
#include "app/job_text.h"
#include "app/light_files.h"
#include "app/measure.h"
#include "app/progress.h"
#include "app/result.h"
#include "radiosity/core/error.h"
#include "radiosity/output/convergence.h"

namespace lambert::app {
namespace {

ExitCode PrintJob(const client::Job& job, const Options& options) {
  const std::string text = options.json ? JsonText(JobJson(job)) : JobLine(job) + "\n";
  std::fputs(text.c_str(), stdout);
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
  auto bundle = ReadLitBundle(options.scene_path, options);
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
  auto sensors = ReadOptionalSensors(options);
  if (!sensors.ok()) return sensors.status();
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
  const auto say = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  absl::Status written = GatherAndWrite(client, job, options, *std::move(sensors), say, *record);
  if (!written.ok()) return written;
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
  if (options.json) std::fputs(JsonText({{"deleted", options.job}}).c_str(), stdout);
  return ExitCode::kDone;
}

}  // namespace lambert::app

#include "app/job_runner.h"

#include <utility>

#include "app/peak_memory.h"
#include "radiosity/core/error.h"

namespace lambert::app {
namespace {

absl::Status Interrupted(const std::string& where) {
  return MakeError(absl::StatusCode::kCancelled, {"INTERRUPTED", where, "stopped by Ctrl-C",
                                                  "run the command again for what is missing"});
}

}  // namespace

absl::StatusOr<FinishedJob> JobRunner::Run(
    const std::string& scene, const PatchOptions& patch, const SolveOptions& solve,
    const std::function<absl::Status(const Snapshot&)>& on_snapshot) {
  if (interrupt_.seen()) return Interrupted("lambert bench");
  client::Client& client = *service_.client;
  if (service_.local != nullptr) ResetPeakMemory();
  const double asked_at_s = MonotonicSeconds();
  auto job = client.CreateJob(scene, patch, solve);
  if (!job.ok()) return job.status();
  interrupt_.OnFirst([&client, name = job->name] {
    if (!client.CancelJob(name).ok()) client.Abort();
  });
  auto finished = Follow(*job, asked_at_s, on_snapshot);
  interrupt_.OnFirst(nullptr);
  printer_.Finish();
  if (!finished.ok()) (void)client.CancelJob(job->name);  // nobody waits for it any more
  (void)client.DeleteJob(job->name);
  if (interrupt_.seen()) return Interrupted(job->name);
  return finished;
}

absl::StatusOr<FinishedJob> JobRunner::Follow(
    const client::Job& job, double asked_at_s,
    const std::function<absl::Status(const Snapshot&)>& on_snapshot) {
  FinishedJob finished;
  const auto note_progress = [&](const Progress& progress) {
    if (finished.setup_s == 0 && progress.rays > 0) {
      finished.setup_s = MonotonicSeconds() - asked_at_s;
    }
    printer_.Update(progress);
  };
  seen_version_ = 0;
  client::WatchOptions watch;
  watch.with_solutions = true;
  watch.on_progress = note_progress;
  watch.on_snapshot = [&](const Snapshot& snapshot) {
    note_progress(snapshot.progress);
    seen_version_ = snapshot.version;
    finished.solution = snapshot.solution;
    return on_snapshot(snapshot);
  };
  auto ended = service_.client->Watch(job.name, watch);
  if (!ended.ok()) return ended.status();
  if (service_.local != nullptr) finished.peak_rss_bytes = PeakMemoryBytes();
  if (ended->state == client::JobState::kFailed) return ended->error;
  if (absl::Status status = TakeLast(*ended, finished, on_snapshot); !status.ok()) return status;
  note_progress(ended->snapshot_progress);
  finished.job = *std::move(ended);
  return finished;
}

absl::Status JobRunner::TakeLast(const client::Job& job, FinishedJob& finished,
                                 const std::function<absl::Status(const Snapshot&)>& on_snapshot) {
  if (job.snapshot_version <= seen_version_) return absl::OkStatus();
  auto solution = service_.client->FetchSolution(job.snapshot);
  if (!solution.ok()) return solution.status();
  finished.solution = *std::move(solution);
  return on_snapshot({job.snapshot_version, job.snapshot_progress, finished.solution});
}

}  // namespace lambert::app

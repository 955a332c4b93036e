#include "server/run/job_runner.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

#include "radiosity/core/digest.h"
#include "radiosity/core/error.h"
#include "radiosity/solve/adapt_mesh.h"
#include "radiosity/solve/plan.h"
#include "server/base/status_proto.h"
#include "server/base/timestamp.h"
#include "server/jobs/spec.h"
#include "server/run/patch_maker.h"

namespace lambert::server {
namespace {

// A snapshot is left out while those before took more than a twentieth of the time.
constexpr double kPublishCostFactor = 20;

// The job stays as it is: this server, or the next, goes on with it.
bool IsInterrupted(const absl::Status& status) {
  return IsOwnershipLost(status) || ReasonOf(status) == "SHUTTING_DOWN";
}

void Tell(const Plan& plan, const PatchSet& patches, Job& job) {
  job.Update([&](v1::SolveJob& record) {
    *record.mutable_plan() = EncodePlan(plan, record.spec());
    record.clear_warnings();
    for (const Warning& warning : patches.warnings) {
      *record.add_warnings() = EncodeWarning(warning);
    }
  });
}

}  // namespace

void JobRunner::Run(Job& job) {
  if (!job.Start()) return;
  Journal journal(job.id(), parts_.blobs, parts_.refs, parts_.records);
  absl::Status status;
  try {
    status = Solve(job, journal);
  } catch (const std::exception& error) {  // memory exhausted, at the worst
    status = MakeError(absl::StatusCode::kResourceExhausted,
                       {"OUT_OF_MEMORY", job.name(), error.what(), "give the server more memory"});
  }
  if (!IsInterrupted(status)) Finish(job, journal, status);
  parts_.work->ForgetJob(job.id());
}

absl::Status JobRunner::Solve(Job& job, Journal& journal) {
  if (absl::Status loaded = journal.Load(); !loaded.ok()) return loaded;
  absl::StatusOr<JobOptions> options = DecodeSpec(job.Get().spec(), parts_.max_patches);
  if (!options.ok()) return options.status();
  absl::StatusOr<std::shared_ptr<const PatchSet>> patches = MakePatches(job, journal, *options);
  if (!patches.ok()) return patches.status();
  const bool adapted = options->patch.adapt_patches > 0;
  if (absl::Status status = ValidateFor(**patches, options->solve, adapted); !status.ok()) {
    return status;
  }
  Plan plan = MakePlan(**patches, options->solve, adapted);
  SolveOptions solve = plan.options;
  if (const v1::SolveJob record = job.Get(); record.has_meshing()) {
    const Meshing meshing = DecodeMeshing(record.meshing());
    plan.items.push_back(TellMeshing(meshing, (*patches)->size()));
    // Meshing was part of the time that was given.
    if (solve.max_time_s > 0) {
      solve.max_time_s = std::max(solve.max_time_s / 2, solve.max_time_s - meshing.seconds);
    }
  }
  Tell(plan, **patches, job);
  if (absl::Status saved = parts_.jobs->Save(job); !saved.ok()) return saved;

  Solver solver(*patches, solve, [this] { return ToSeconds(parts_.clock().time_since_epoch()); });
  absl::StatusOr<std::string> checkpoint = journal.Checkpoint();
  if (!checkpoint.ok()) return checkpoint.status();
  if (!checkpoint->empty()) {
    if (absl::Status restored = solver.Restore(*checkpoint); !restored.ok()) return restored;
  }
  JobSteps steps(parts_, job, journal, (*patches)->size(), solve.shoot,
                 solver.MakeSnapshot().progress);
  const absl::Status status = RunPasses(job, journal, solver, steps);
  steps.LogSummary();
  return status;
}

absl::StatusOr<std::shared_ptr<const PatchSet>> JobRunner::MakePatches(Job& job, Journal& journal,
                                                                       const JobOptions& options) {
  PatchMaker maker(parts_, job, journal);
  absl::StatusOr<std::shared_ptr<const PatchSet>> patches = maker.Make(options);
  if (patches.ok() || IsInterrupted(patches.status())) return patches;
  absl::StatusOr<std::optional<PilotResult>> best = maker.TakeBest();
  if (!best.ok()) return best.status();
  if (!best->has_value()) return patches;
  Tell((*best)->plan, *(*best)->patches, job);
  absl::Status published = Publish(job, journal, nullptr, (*best)->snapshot);
  if (!published.ok()) return published;
  return patches;
}

absl::Status JobRunner::RunPasses(Job& job, Journal& journal, Solver& solver, JobSteps& steps) {
  bool is_published = false;
  double published_at_s = 0, cost_s = 0;
  const auto on_step = [&](const Progress& progress) { steps.OnStep(progress); };
  absl::Status status;
  while (status.ok() && solver.stop_reason() == StopReason::kNone) {
    status = solver.RunPass(steps.executor(), on_step);
    const double now_s = ToSeconds(parts_.clock().time_since_epoch());
    is_published = false;
    if (!status.ok() || (cost_s > 0 && now_s - published_at_s < kPublishCostFactor * cost_s)) {
      continue;
    }
    if (absl::Status published = Publish(job, journal, solver); !published.ok()) return published;
    is_published = true;
    published_at_s = ToSeconds(parts_.clock().time_since_epoch());
    cost_s = published_at_s - now_s;
  }
  const bool has_news = job.snapshots().empty() || !is_published;
  if (has_news && !IsInterrupted(status) &&
      (status.ok() || solver.MakeSnapshot().progress.rays > 0)) {
    if (absl::Status published = Publish(job, journal, solver); !published.ok()) return published;
  }
  job.Update([&](v1::SolveJob& record) {
    record.set_stop_reason(EncodeStopReason(solver.stop_reason()));
    record.set_reached_goal(status.ok() && solver.reached_goal());
  });
  return status;
}

absl::Status JobRunner::Publish(Job& job, Journal& journal, const Solver* solver,
                                const lambert::Snapshot& made) {
  std::string payload = EncodeSolution(*made.solution);
  v1::Snapshot snapshot;
  snapshot.set_version(job.Get().latest_snapshot().version() + 1);
  snapshot.set_name(job.name() + "/snapshots/" + std::to_string(snapshot.version()));
  *snapshot.mutable_progress() = EncodeProgress(made.progress);
  const std::string sha256 = Sha256Hex(payload);
  snapshot.mutable_payload_digest()->set_sha256(sha256);
  snapshot.mutable_payload_digest()->set_size_bytes(static_cast<int64_t>(payload.size()));
  *snapshot.mutable_create_time() = TimestampNow();
  parts_.refs->Add(sha256);
  if (absl::Status stored = parts_.blobs->Put(sha256, std::move(payload)); !stored.ok()) {
    parts_.refs->Release(sha256);
    return stored;
  }
  absl::Status published;
  if (journal.keeps() && solver != nullptr) {
    absl::StatusOr<RecordChange> change = journal.Replace(solver->EncodeCheckpoint());
    published = change.ok() ? parts_.jobs->Publish(job, snapshot, {*change}) : change.status();
    if (published.ok()) journal.Settle();
  } else {
    published = parts_.jobs->Publish(job, snapshot, {});
  }
  if (!published.ok() && !IsOwnershipLost(published)) parts_.refs->Release(sha256);
  return published;
}

void JobRunner::Finish(Job& job, Journal& journal, const absl::Status& status) {
  const auto end = [&](v1::SolveJob& record) {
    *record.mutable_end_time() = TimestampNow();
    if (status.ok()) {
      record.set_state(v1::SolveJob::STATE_SUCCEEDED);
    } else if (absl::IsCancelled(status)) {
      record.set_state(v1::SolveJob::STATE_CANCELLED);
    } else {
      record.set_state(v1::SolveJob::STATE_FAILED);
      *record.mutable_error() = ToStatusProto(status);
    }
  };
  const absl::Status saved = parts_.jobs->Update(job, end, {journal.Clear()});
  if (IsOwnershipLost(saved)) return;
  if (saved.ok()) {
    journal.Settle();
  } else {
    job.Update(end);
  }
  const v1::SolveJob record = job.Get();
  parts_.log({v1::SolveJob::State_Name(record.state()) + " after " +
                  std::to_string(record.progress().ray_count()) + " rays" +
                  (status.ok() ? "" : ": " + std::string(status.message())) +
                  (saved.ok() ? ""
                              : " (its record could not be written: " +
                                    std::string(saved.message()) + ")"),
              {.job = job.name()}});
}

}  // namespace lambert::server

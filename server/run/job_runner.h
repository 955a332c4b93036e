// Solves one job: scene, patches, plan, passes, snapshots.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "radiosity/core/log.h"
#include "radiosity/patch/patch_set.h"
#include "radiosity/solve/solver.h"
#include "server/base/clock.h"
#include "server/blobs/blob_refs.h"
#include "server/blobs/blob_store.h"
#include "server/doors/holdings.h"
#include "server/jobs/job.h"
#include "server/jobs/job_store.h"
#include "server/jobs/journal.h"
#include "server/jobs/spec.h"
#include "server/run/journal_executor.h"
#include "server/scenes/scene_store.h"
#include "server/work/work_table.h"

namespace lambert::server {

// What jobs and gathers are run with; all of it outlives who runs them and is thread safe.
struct RunnerParts {
  BlobStore* blobs = nullptr;
  BlobRefs* refs = nullptr;
  RecordStore* records = nullptr;
  SceneStore* scenes = nullptr;
  JobStore* jobs = nullptr;
  const Holdings* holdings = nullptr;
  Quotas* quotas = nullptr;
  WorkTable* work = nullptr;
  int64_t max_patches = 0;
  JournalMode journal = JournalMode::kAuto;
  Clock clock;
  Log log;
};

// Thread safe: runs any number of jobs at once, one a thread.
class JobRunner {
 public:
  explicit JobRunner(RunnerParts parts) : parts_(std::move(parts)) {}

  // Blocks until the job has ended, or the server is shutting down: the job then stays as it is, to
  // be gone on with from its last step. Never throws.
  void Run(Job& job);

 private:
  absl::Status Solve(Job& job, Journal& journal);
  // The job's patch set: built from the scene and stored, or read back after a restart.
  absl::StatusOr<std::shared_ptr<const PatchSet>> PreparePatches(Job& job,
                                                                 const PatchOptions& options);
  absl::Status RunPasses(Job& job, Journal& journal, Solver& solver, StepExecutor& executor);
  // Stores the solution and what a restart needs, in one transaction; then watchers have it.
  absl::Status Publish(Job& job, Journal& journal, const Solver& solver);
  void Finish(Job& job, Journal& journal, const absl::Status& status);

  const RunnerParts parts_;
};

}  // namespace lambert::server
